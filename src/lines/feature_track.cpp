#include "sightline/lines/feature_track.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "sightline/geometry/statistics.h"

namespace sightline::lines {

namespace {

using geometry::FeatureBehaviour;
using geometry::FeatureKind;

constexpr FeatureBehaviour kBehaviours[] = {FeatureBehaviour::kFixed, FeatureBehaviour::kSliding,
                                            FeatureBehaviour::kMoving};

constexpr struct {
  // A hypothesis below takes no sighting for its own.
  double ruled_out = 0.01;
  // Share of the sightings that are misplaced, as where a wall was cut wrongly, and how far [m].
  double misplaced = 0.1;
  double misplaced_by = 0.05;
  // Features that are new, where one is seen [1/m²]: ten in a room.
  double new_density = 0.5;
  // Two tracks of one feature may be so far apart [m].
  double most_apart = 0.1;
} kTrack;

// What things of a kind are found to do, before they were watched.
std::array<double, 3> priorOf(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::kCorner:
      return {0.93, 0.02, 0.05};
    case FeatureKind::kEdge:
      return {0.70, 0.25, 0.05};
    case FeatureKind::kLineEnd:
      return {0.01, 0.94, 0.05};
    case FeatureKind::kArc:
      break;
  }
  return {0.80, 0.0, 0.20};
}

// A corner of which one wall is seen looks like an edge. A centre is no place on a surface, and
// where the view of a wall ends is none that the wall has.
bool areAlike(FeatureKind a, FeatureKind b) {
  const auto isOfWall = [](FeatureKind kind) {
    return kind == FeatureKind::kCorner || kind == FeatureKind::kEdge;
  };
  return a == b || (isOfWall(a) && isOfWall(b));
}

double densityWithMisplaced(const FeatureHypothesis::Innovation& innovation) {
  FeatureHypothesis::Innovation wide = innovation;
  wide.covariance += kTrack.misplaced_by * kTrack.misplaced_by * Eigen::Matrix2d::Identity();
  return (1.0 - kTrack.misplaced) * innovation.density() + kTrack.misplaced * wide.density();
}

}  // namespace

FeatureTrack::FeatureTrack(std::uint32_t id, const Sighting& sighting,
                           const FeatureTrackerConfig& config)
    : id_(id),
      config_(&config),
      kind_(sighting.kind),
      hypotheses_{FeatureHypothesis(kBehaviours[0], config),
                  FeatureHypothesis(kBehaviours[1], config),
                  FeatureHypothesis(kBehaviours[2], config)},
      probabilities_(priorOf(sighting.kind)) {
  for (FeatureHypothesis& hypothesis : hypotheses_) hypothesis.start(sighting);
}

std::size_t FeatureTrack::likeliestIndex() const {
  return static_cast<std::size_t>(std::max_element(probabilities_.begin(), probabilities_.end()) -
                                  probabilities_.begin());
}

const FeatureHypothesis& FeatureTrack::likeliest() const {
  return hypotheses_[likeliestIndex()];
}

void FeatureTrack::predict(const ViewChange& change) {
  for (FeatureHypothesis& hypothesis : hypotheses_) hypothesis.predict(change);
  age_ += change.elapsed;
  unseen_ += change.elapsed;
  this->change(change.elapsed);
}

// What is at rest may set off, and what moves may stop.
void FeatureTrack::change(double elapsed) {
  auto& [fixed, sliding, moving] = probabilities_;
  const double start = 1.0 - std::exp(-config_->start_rate * elapsed);
  const double stop = 1.0 - std::exp(-config_->stop_rate * elapsed);
  const double starting = start * (fixed + sliding);
  const double stopping = stop * moving;
  fixed = (1.0 - start) * fixed + stopping;
  sliding *= 1.0 - start;
  moving += starting - stopping;
}

double FeatureTrack::density(const Sighting& sighting) const {
  if (!areAlike(kind_, sighting.kind)) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    sum += probabilities_[i] * densityWithMisplaced(hypotheses_[i].innovation(sighting));
  }
  return sum;
}

bool FeatureTrack::mayBe(const Sighting& sighting) const {
  return density(sighting) > kTrack.new_density;
}

bool FeatureTrack::isAt(const FeatureTrack& other) const {
  if (!areAlike(kind_, other.kind_)) return false;
  const Eigen::Vector2d apart = position() - other.position();
  const Eigen::Matrix2d sum = covariance() + other.covariance();
  return apart.norm() < kTrack.most_apart &&
         apart.dot(sum.inverse() * apart) < geometry::chiSquareLimitOf2(config_->gate);
}

void FeatureTrack::absorb(const FeatureTrack& other) {
  const FeatureTrack own = *this;
  if (other.sightings_ > sightings_) *this = other;
  id_ = std::min(own.id_, other.id_);
  if (own.kind_ == FeatureKind::kCorner || other.kind_ == FeatureKind::kCorner) {
    kind_ = FeatureKind::kCorner;
  }
  age_ = std::max(own.age_, other.age_);
  unseen_ = std::min(own.unseen_, other.unseen_);
  missed_ = std::min(own.missed_, other.missed_);
  sightings_ = own.sightings_ + other.sightings_;
}

void FeatureTrack::weigh(const Sighting& sighting) {
  double sum = 0.0;
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    probabilities_[i] *= densityWithMisplaced(hypotheses_[i].innovation(sighting));
    sum += probabilities_[i];
  }
  for (double& probability : probabilities_) probability /= sum;
}

// What is known of the behaviour of a kind, in place of what was thought of another.
void FeatureTrack::take(FeatureKind kind) {
  if (kind == kind_ || kind_ == FeatureKind::kCorner) return;
  const Probabilities before = priorOf(kind_);
  const Probabilities now = priorOf(kind);
  double sum = 0.0;
  for (std::size_t i = 0; i < probabilities_.size(); ++i) {
    probabilities_[i] *= now[i] / before[i];
    sum += probabilities_[i];
  }
  for (double& probability : probabilities_) probability /= sum;
  kind_ = kind;
}

void FeatureTrack::see(const Sighting& sighting) {
  weigh(sighting);
  const double gate = geometry::chiSquareLimitOf2(config_->gate);
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    const bool fits = hypotheses_[i].innovation(sighting).nis() < gate;
    if (fits) {
      hypotheses_[i].update(sighting);
    } else if (probabilities_[i] < kTrack.ruled_out) {
      // Begins anew where the thing is now: it may have changed its behaviour.
      hypotheses_[i].restart(sighting);
    }
  }
  take(sighting.kind);
  unseen_ = 0.0;
  missed_ = 0.0;
  ++sightings_;
}

bool FeatureTrack::isFinite() const {
  return std::all_of(hypotheses_.begin(), hypotheses_.end(),
                     [](const FeatureHypothesis& hypothesis) { return hypothesis.isFinite(); }) &&
         std::isfinite(probabilities_[0] + probabilities_[1] + probabilities_[2]);
}

FeatureBehaviour FeatureTrack::behaviour() const {
  const std::size_t i = likeliestIndex();
  return probabilities_[i] >= config_->decided ? kBehaviours[i] : FeatureBehaviour::kUndecided;
}

geometry::Feature FeatureTrack::in(const geometry::Pose2& T_target_base) const {
  const Eigen::Matrix2d R = T_target_base.rotation();
  geometry::Feature feature;
  feature.id = id_;
  feature.kind = kind_;
  feature.position = T_target_base * position();
  feature.covariance = R * covariance() * R.transpose();
  feature.velocity = R * likeliest().velocity();
  feature.behaviour = behaviour();
  feature.fixed_probability = probabilities_[0];
  feature.sliding_probability = probabilities_[1];
  feature.moving_probability = probabilities_[2];
  feature.age = age_;
  feature.unseen = unseen_;
  feature.sightings = sightings_;
  return feature;
}

}  // namespace sightline::lines
