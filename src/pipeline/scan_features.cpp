#include "sightline/pipeline/scan_features.h"

namespace sightline::pipeline {

namespace {

// Uncertainty of the motion over a break in the odometry [m, rad].
constexpr double kBrokenPosition = 0.1;
constexpr double kBrokenHeading = 0.1;

}  // namespace

std::optional<ScanFeatures::Place> ScanFeatures::placeOf(
    const LocatedScan& located,
    const std::optional<dead_reckoning::DeadReckoningUpdate>& odometry) {
  if (!located.T_base_sensor) return std::nullopt;
  if (located.T_odom_base) {
    return Place{true, {located.T_path_base.value_or(*located.T_odom_base)}, *located.T_odom_base};
  }
  if (!odometry) return std::nullopt;
  return Place{false, {odometry->pose.mean, odometry->step.covariance}, odometry->pose.mean};
}

lines::CarrierStep ScanFeatures::stepTo(const Place& place) const {
  if (!before_) return {};
  const geometry::Pose2 step = geometry::between(before_->T_path_base.mean, place.T_path_base.mean);
  if (!place.by_wheels) return lines::CarrierStep::byScans({step, place.T_path_base.covariance});
  return lines::CarrierStep::byWheels(tracker_.config().odometry, step);
}

std::optional<std::vector<geometry::Feature>> ScanFeatures::take(
    const LocatedScan& located, const std::optional<dead_reckoning::DeadReckoningUpdate>& odometry,
    Lines& lines) {
  const auto place = placeOf(located, odometry);
  if (!place) return std::nullopt;
  if (before_ && before_->by_wheels != place->by_wheels) restart();
  if (before_ && located.odometry_broke) tracker_.inflate(kBrokenPosition, kBrokenHeading);
  tracker_.update(
      {located.scan, lines.segments, lines.arcs, stepTo(*place), *located.T_base_sensor});
  before_ = place;
  return tracker_.features(place->T_odom_base);
}

void ScanFeatures::restart() {
  tracker_.restart();
  before_.reset();
}

}  // namespace sightline::pipeline
