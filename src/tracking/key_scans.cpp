#include "sightline/tracking/key_scans.h"

#include <algorithm>
#include <cmath>

namespace sightline::tracking {

namespace {

using geometry::Pose2;

constexpr struct {
  double distance = 0.3;  // [m]
  double turn = 0.35;     // [rad]
  std::size_t most = 12;
  std::size_t most_beams = 90;
  double tolerance = 0.15;  // of a beam that ends on a wall, the odometry's drift included [m]
} kKeys;

constexpr struct {
  double length = 2.0;          // [m]
  double turn = geometry::kPi;  // [rad]
} kClaim;

}  // namespace

bool isAnotherView(const Pose2& T_odom_base, const Pose2& T_odom_other) {
  const Pose2 moved = geometry::between(T_odom_base, T_odom_other);
  return moved.translation().norm() >= kKeys.distance || std::abs(moved.theta()) >= kKeys.turn;
}

bool KeyScans::isNew(const TrackerInput& input) const {
  return scans_.empty() || isAnotherView(scans_.back().T_odom_view, input.T_odom_base);
}

void KeyScans::add(const TrackerInput& input) {
  const bool is_new = isNew(input);
  const Pose2 T_odom_view = is_new ? input.T_odom_base : scans_.back().T_odom_view;
  if (!is_new) scans_.pop_back();
  scans_.push_back({input.scan, input.T_odom_base, input.T_base_sensor, T_odom_view});
  if (scans_.size() > kKeys.most) scans_.pop_front();
}

double KeyScans::logLikelihoodBefore(const world::RoomMap& map, const Pose2& T_map_base,
                                     double usual_hits) const {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < scans_.size(); ++i) {
    const KeyScan& key = scans_[i];
    const Pose2 T_map_key =
        T_map_base * geometry::between(scans_.back().T_odom_base, key.T_odom_base);
    const Pose2 T_map_sensor = T_map_key * key.T_base_sensor;
    const auto inside = map.roomAt(T_map_sensor.translation());
    const std::size_t room = inside ? *inside : map.nearestRoom(T_map_sensor.translation());
    const world::RoomView view(map, room, T_map_sensor.translation(),
                               world::RoomView::Doors::kOpen);
    const std::size_t stride = std::max<std::size_t>(1, key.scan.beams() / kKeys.most_beams);
    sum += logLikelihood(scanAgreement(key.scan, T_map_sensor, view, kKeys.tolerance, stride),
                         *key.scan.geometry(), usual_hits);
  }
  return sum;
}

void WayTravelled::add(const Pose2& T_odom_base) {
  if (last_) {
    const Pose2 step = geometry::between(*last_, T_odom_base);
    length_ += step.translation().norm();
    turn_ += step.theta();
  }
  last_ = T_odom_base;
}

bool WayTravelled::isEnough() const {
  return length_ >= kClaim.length || std::abs(turn_) >= kClaim.turn;
}

}  // namespace sightline::tracking
