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
  startAnywhere();
}

void RoomTracker::configure(const TrackerConfig& config) {
  config::validate(config);
  const bool is_another = config.method != context_.config.method;
  context_.config = config;
  if (!is_another) return;
  const auto before = poseAndRoom();
  if (before) {
    start(before->first, before->second);
  } else {
    startAnywhere();
  }
}

std::optional<std::pair<geometry::UncertainPose2, std::size_t>> RoomTracker::poseAndRoom() const {
  if (const auto* plain = std::get_if<PlainTracker>(&method_)) {
    return std::make_pair(plain->pose(), plain->room());
  }
  const auto* full = std::get_if<RivalTracks>(&method_);
  if (!full || !full->pose()) return std::nullopt;
  return std::make_pair(*full->pose(), *full->room());
}

void RoomTracker::startAnywhere() {
  if (context_.config.method == Method::kFull) {
    method_.emplace<RivalTracks>();
  } else {
    method_.emplace<std::monostate>();
  }
}

void RoomTracker::start(const geometry::UncertainPose2& T_map_base, std::size_t room) {
  if (context_.config.method == Method::kFull) {
    method_.emplace<RivalTracks>(context_, T_map_base, room);
  } else {
    method_.emplace<PlainTracker>(context_, T_map_base, room);
  }
}

bool RoomTracker::relocalise() {
  if (context_.config.method != Method::kFull) return false;
  startAnywhere();
  return true;
}

bool RoomTracker::hasPose() const {
  const auto* full = std::get_if<RivalTracks>(&method_);
  return full ? full->isStarted() : std::holds_alternative<PlainTracker>(method_);
}

std::vector<RivalPose> RoomTracker::rivals() const {
  const auto* full = std::get_if<RivalTracks>(&method_);
  return full ? full->rivals() : std::vector<RivalPose>();
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
  ifStarted(method_, [&](auto& tracker) { tracker.setRoom(*room); });
  inflate(context_.config.threshold_position_sigma, context_.config.threshold_heading_sigma);
  return true;
}

void RoomTracker::replaceMap(world::RoomMap map) {
  const auto before = poseAndRoom();
  context_.map = std::move(map);
  if (before) {
    setPose(before->first);
  } else {
    startAnywhere();
  }
}

void RoomTracker::restartClock() {
  ifStarted(method_, [](auto& tracker) { tracker.restartClock(); });
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
