#include "sightline/tracking/room_tracker.h"

#include <type_traits>
#include <utility>

namespace sightline::tracking {

namespace {

// Calls a function of the method's tracker, where there is a pose to track from.
template <class Method, class Function>
void ifStarted(Method& method, const Function& function) {
  const auto call = [&](auto& tracker) {
    if constexpr (!std::is_same_v<std::decay_t<decltype(tracker)>, std::monostate>) {
      function(tracker);
    }
  };
  std::visit(call, method);
}

}  // namespace

RoomTracker::RoomTracker(const TrackerConfig& config, world::RoomMap map)
    : context_{config, std::move(map)} {
  config::validate(config);
}

void RoomTracker::configure(const TrackerConfig& config) {
  config::validate(config);
  const bool is_another = config.method != context_.config.method;
  context_.config = config;
  if (!is_another) return;
  auto before = method_;
  ifStarted(before, [&](auto& tracker) { start(tracker.pose(), tracker.memory().room()); });
}

void RoomTracker::start(const geometry::UncertainPose2& T_map_base, std::size_t room) {
  switch (context_.config.method) {
    case Method::kFull:
      method_.emplace<PoseTrack>(context_, T_map_base, room);
      return;
    case Method::kPlain:
      method_.emplace<PlainTracker>(context_, T_map_base, room);
      return;
  }
}

void RoomTracker::setPose(const geometry::UncertainPose2& T_map_base) {
  const Eigen::Vector2d position = T_map_base.mean.translation();
  const auto room = context_.map.roomAt(position);
  start(T_map_base, room ? *room : context_.map.nearestRoom(position));
}

void RoomTracker::inflate(double position_sigma, double heading_sigma) {
  ifStarted(method_, [&](auto& tracker) { tracker.inflate(position_sigma, heading_sigma); });
}

bool RoomTracker::setRoom(const std::string& name) {
  const auto room = context_.map.find(name);
  if (!room) return false;
  ifStarted(method_, [&](auto& tracker) { tracker.memory().setRoom(*room); });
  inflate(context_.config.threshold_position_sigma, context_.config.threshold_heading_sigma);
  return true;
}

void RoomTracker::replaceMap(world::RoomMap map) {
  context_.map = std::move(map);
  auto before = method_;
  ifStarted(before, [&](auto& tracker) { setPose(tracker.pose()); });
}

void RoomTracker::restartClock() {
  ifStarted(method_, [](auto& tracker) { tracker.memory().restartClock(); });
}

std::optional<TrackerUpdate> RoomTracker::update(const scan::Scan& scan,
                                                 const geometry::Pose2& T_odom_base,
                                                 const geometry::Pose2& T_base_sensor) {
  std::optional<TrackerUpdate> result;
  if (!T_odom_base.isFinite() || !T_base_sensor.isFinite()) return result;
  const TrackerInput input{scan, T_odom_base, T_base_sensor};
  ifStarted(method_, [&](auto& tracker) { result = tracker.update(context_, input); });
  return result;
}

}  // namespace sightline::tracking
