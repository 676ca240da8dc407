#include "sightline/gaze/informing_head.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sightline::gaze {

namespace {

// Longest time between two poses that is taken for the period of the sensor's scans [s].
constexpr double kLongestPeriod = 2.0;

}  // namespace

InformingHead::InformingHead(const GazeConfig& config, const CarrierMotion& motion)
    : config_(&config), motion_(&motion), informative_(config), visibility_(config.inform.forget) {}

void InformingHead::setMap(world::RoomMap map) {
  map_ = std::move(map);
  visibility_.clear();
  uncertainty_.reset();
}

void InformingHead::clearPose() {
  T_map_base_.reset();
  uncertainty_.reset();
  chosen_at_ = 0;
  scanned_at_ = 0;
}

std::optional<InformingHead::Carried> InformingHead::carriedTo(std::int64_t stamp) const {
  if (!T_map_base_ || !uncertainty_) return std::nullopt;
  const auto before = motion_->at(told_at_);
  const auto at = motion_->at(stamp);
  if (!before || !at) return std::nullopt;
  const geometry::Pose2 step = geometry::between(*before, *at);
  Carried carried{T_map_base_->mean * step, *uncertainty_};
  carried.uncertainty.predict(T_map_base_->mean, step, config_->odometry);
  return carried;
}

void InformingHead::takePose(std::int64_t stamp, const geometry::UncertainPose2& T_map_base) {
  const auto carried = carriedTo(stamp);
  const InformConfig& inform = config_->inform;
  uncertainty_ = carried ? carried->uncertainty
                         : PoseUncertainty(T_map_base.covariance, {inform.wall_position_sigma,
                                                                   inform.wall_direction_sigma});
  const double elapsed = 1e-9 * static_cast<double>(stamp - told_at_);
  if (T_map_base_ && elapsed > 0.0 && elapsed < kLongestPeriod) pose_period_ = elapsed;
  T_map_base_ = T_map_base;
  told_at_ = stamp;
  uncertainty_->adopt(T_map_base.covariance);
}

// The tracker says the pose once it has taken the scan: what its walls did to it is kept until
// then.
void InformingHead::takeScan(const scan::Scan& scan, const geometry::Pose2& T_base_mount,
                             const geometry::Pose2& T_mount_sensor) {
  const auto carried = carriedTo(scan.stamp);
  if (!map_ || map_->rooms().empty() || !carried) return;
  const geometry::Pose2& T_map_base = carried->T_map_base;
  const auto beams = mapBeams(scan, *map_, map_->nearestRoom(T_map_base.translation()),
                              T_map_base * T_base_mount * T_mount_sensor);
  const double elapsed = 1e-9 * static_cast<double>(std::max<std::int64_t>(
                                    0, scan.stamp - std::exchange(scanned_at_, scan.stamp)));
  visibility_.take(beams, std::min(elapsed, 10.0));
  WallLooks looks(*map_);
  for (const MappedBeam& beam : beams) {
    if (beam.meets_wall) looks.add(beam.sighting, 1.0 / beam.variance);
  }
  for (const WallLook& look : looks.all()) {
    if (look.to - look.from < config_->inform.least_length) continue;
    uncertainty_->take(look, T_map_base.translation(), 1.0);
  }
  if (told_at_ >= scan.stamp) uncertainty_->adopt(T_map_base_->covariance);
}

Look InformingHead::choose(const Carried& carried, const geometry::Pose2& T_base_mount,
                           double head_angle) const {
  LookingPlace place;
  place.T_map_base = carried.T_map_base;
  place.uncertainty = carried.uncertainty;
  place.T_base_mount = T_base_mount;
  place.room = map_->nearestRoom(carried.T_map_base.translation());
  place.head_angle = head_angle;
  place.twist = motion_->twist();
  place.scan_period = pose_period_;
  return informative_.choose(place, *map_, visibility_);
}

InformingHead::Choice InformingHead::choose(std::int64_t now,
                                            const std::optional<geometry::Pose2>& T_base_mount,
                                            double head_angle) {
  if (!map_ || map_->rooms().empty()) return {{}, "no map"};
  if (!T_base_mount) return {{}, "the mounting of the head is not known"};
  if (!T_map_base_ || now - told_at_ > std::llround(1e9 * config_->patience))
    return {{}, "no pose"};
  const auto carried = carriedTo(now);
  if (!carried) return {{}, "no odometry"};
  if (now - chosen_at_ >= std::llround(1e9 * config_->inform.period)) {
    chosen_at_ = now;
    look_ = choose(*carried, *T_base_mount, head_angle);
  }
  if (!look_.has_walls) return {{}, "no wall of the map is within reach"};
  return {look_.angle, ""};
}

}  // namespace sightline::gaze
