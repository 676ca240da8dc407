#include "sightline/lines/feature_tracker.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/angle.h"
#include "sightline/lines/place_in_view.h"

namespace sightline::lines {

namespace {

using geometry::Pose2;

constexpr struct {
  // Standard deviations of its place within which a feature is looked for in the view.
  double spread = 3.0;
  double least_spread = 0.02;  // [m]
  // A feature that few scans showed is given up after so many misses, about as many scans.
  std::uint32_t few_sightings = 5;
} kTracking;

double largestSigma(const Eigen::Matrix2d& covariance) {
  return std::sqrt(covariance.trace());
}

FeatureTrackerConfig checkedConfig(const FeatureTrackerConfig& config) {
  config::validate(config);
  return config;
}

}  // namespace

FeatureTracker::FeatureTracker(const FeatureTrackerConfig& config)
    : config_(checkedConfig(config)), walls_(config_) {}

double FeatureTracker::elapsedTo(std::int64_t stamp) {
  const std::int64_t before = stamp_.value_or(stamp);
  stamp_ = std::max(before, stamp);
  return 1e-9 * static_cast<double>(*stamp_ - before);
}

void FeatureTracker::update(const ObservedLines& observed) {
  const double elapsed = elapsedTo(observed.scan.stamp);
  predict(observed, elapsed);
  std::vector<Sighting> sightings = sightingsIn(observed.scan, observed.segments, observed.arcs);
  for (Sighting& sighting : sightings) sighting = observed.T_base_sensor * sighting;
  assign(sightings, observed, elapsed);
  unite();
  forget();
  walls_.identify(observed.segments, observed.T_base_sensor);
}

void FeatureTracker::predict(const ObservedLines& observed, double elapsed) {
  for (FeatureTrack& track : tracks_) track.predict(viewChange(track, observed, elapsed));
  walls_.predict(observed.step, elapsed);
  T_base_sensor_ = observed.T_base_sensor;
}

ViewChange FeatureTracker::viewChange(const FeatureTrack& track, const ObservedLines& observed,
                                      double elapsed) const {
  ViewChange change{observed.step, elapsed};
  const Eigen::Vector2d before = T_base_sensor_.inverse() * track.position();
  const Pose2 T_before_now =
      T_base_sensor_.inverse() * observed.step.T_before_now * observed.T_base_sensor;
  const Eigen::Vector2d now = T_before_now.inverse() * before;
  const Eigen::Vector2d bearing = before.normalized();
  change.sideways = bearing.x() * T_before_now.y() - bearing.y() * T_before_now.x();
  const double turned =
      geometry::wrapAngle(std::atan2(now.y(), now.x()) - std::atan2(before.y(), before.x()));
  const double beams = std::abs(turned / observed.scan.geometry()->angleIncrement());
  change.beam_correlation = std::exp(-beams);
  return change;
}

std::vector<FeatureTracker::Pair> FeatureTracker::pairs(
    const std::vector<Sighting>& sightings) const {
  std::vector<Pair> result;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    for (std::size_t s = 0; s < sightings.size(); ++s) {
      if (!tracks_[t].mayBe(sightings[s])) continue;
      result.push_back({t, s, tracks_[t].density(sightings[s])});
    }
  }
  std::sort(result.begin(), result.end(),
            [](const Pair& a, const Pair& b) { return a.density > b.density; });
  return result;
}

void FeatureTracker::assign(const std::vector<Sighting>& sightings, const ObservedLines& observed,
                            double elapsed) {
  std::vector<std::uint32_t> ids(sightings.size(), 0);
  std::vector<bool> seen(tracks_.size(), false);
  for (const Pair& pair : pairs(sightings)) {
    if (seen[pair.track] || ids[pair.sighting] != 0) continue;
    seen[pair.track] = true;
    ids[pair.sighting] = tracks_[pair.track].id();
    tracks_[pair.track].see(sightings[pair.sighting]);
  }
  missUnseen(observed, elapsed);
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (ids[i] == 0) {
      ids[i] = ++last_id_;
      tracks_.emplace_back(ids[i], sightings[i], config_);
    }
    if (sightings[i].arc) observed.arcs[*sightings[i].arc].id = ids[i];
  }
}

void FeatureTracker::missUnseen(const ObservedLines& observed, double elapsed) {
  const Pose2 T_sensor_base = observed.T_base_sensor.inverse();
  for (FeatureTrack& track : tracks_) {
    if (track.unseen() == 0.0) continue;
    const double spread =
        std::max(kTracking.least_spread, kTracking.spread * largestSigma(track.covariance()));
    const auto view = lookAt(T_sensor_base * track.position(), spread, observed.scan);
    if (view == PlaceInView::kSeen) track.miss(elapsed);
  }
}

// Two tracks may have begun on one feature, as when it was lost from sight for long. No scan shows
// both.
void FeatureTracker::unite() {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (tracks_[i].unseen() > 0.0) continue;
    for (std::size_t k = 0; k < tracks_.size(); ++k) {
      if (tracks_[k].unseen() == 0.0 || !tracks_[i].isAt(tracks_[k])) continue;
      tracks_[i].absorb(tracks_[k]);
      tracks_.erase(tracks_.begin() + static_cast<long>(k));
      i -= k < i ? 1 : 0;
      k -= 1;
    }
  }
}

void FeatureTracker::forget() {
  const auto isGone = [&](const FeatureTrack& track) {
    const double ripeness = std::min(
        1.0, static_cast<double>(track.sightings()) / static_cast<double>(kTracking.few_sightings));
    return !track.isFinite() || track.missed() > ripeness * config_.absence ||
           largestSigma(track.covariance()) > config_.forgotten_sigma;
  };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), isGone), tracks_.end());
  const auto most = static_cast<std::size_t>(config_.max_features);
  if (tracks_.size() <= most) return;
  std::stable_sort(tracks_.begin(), tracks_.end(), [](const auto& a, const auto& b) {
    if (a.unseen() != b.unseen()) return a.unseen() < b.unseen();
    return a.covariance().trace() < b.covariance().trace();
  });
  tracks_.erase(tracks_.begin() + static_cast<long>(most), tracks_.end());
  std::sort(tracks_.begin(), tracks_.end(),
            [](const auto& a, const auto& b) { return a.id() < b.id(); });
}

void FeatureTracker::inflate(double position_sigma, double heading_sigma) {
  CarrierStep step;
  step.covariance = Eigen::Vector3d(position_sigma, position_sigma, heading_sigma)
                        .array()
                        .square()
                        .matrix()
                        .asDiagonal();
  ViewChange change{step};
  change.beam_correlation = 1.0;
  for (FeatureTrack& track : tracks_) track.predict(change);
  walls_.predict(step, 0.0);
}

void FeatureTracker::restart() {
  tracks_.clear();
  walls_.clear();
  stamp_.reset();
}

std::vector<geometry::Feature> FeatureTracker::features(const Pose2& T_odom_base) const {
  std::vector<geometry::Feature> features;
  features.reserve(tracks_.size());
  for (const FeatureTrack& track : tracks_) features.push_back(track.in(T_odom_base));
  return features;
}

}  // namespace sightline::lines
