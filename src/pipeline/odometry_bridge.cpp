#include "sightline/pipeline/odometry_bridge.h"

#include <algorithm>
#include <cmath>

#include "sightline/pipeline/seconds_between.h"

namespace sightline::pipeline {

using geometry::Pose2;

namespace {

constexpr struct {
  // Odometry is off by this much from one moment to the next: it is rounded, and stamped late [m,
  // rad].
  double position = 0.05;
  double heading = 0.05;
  // Change of speed that the friction of wheels on a floor does not allow [m/s²].
  double acceleration = 15.0;
  // Time for which a carrier is taken to go on as before, at most [s].
  double pause = 1.0;
  // Stretches in which a path is looked at [ns], and the most of them.
  std::int64_t stretch = 20'000'000;
  std::int64_t most = 64;
} kBridge;

std::int64_t stretchesBetween(std::int64_t from, std::int64_t to) {
  return std::clamp<std::int64_t>((to - from) / kBridge.stretch, 1, kBridge.most);
}

}  // namespace

void OdometryLimits::visit(config::FieldVisitor& visitor) {
  visitor.number("max_speed", max_speed,
                 {"m/s", {0.01, 1000.0}, "speed beyond which odometry did not move, but broke"});
  visitor.number("max_turn_rate", max_turn_rate,
                 {"rad/s", {0.01, 1000.0}, "turn rate beyond which it broke"});
}

bool OdometryLimits::allow(const Pose2& step, double seconds) const {
  const double elapsed = std::max(seconds, 0.0);
  return step.translation().norm() <= max_speed * elapsed + kBridge.position &&
         std::abs(step.theta()) <= max_turn_rate * elapsed + kBridge.heading;
}

bool isSamePlace(const Pose2& before, const Pose2& after) {
  constexpr double kSame = 1.0;  // [m, rad]
  const Pose2 step = geometry::between(before, after);
  return step.translation().norm() < kSame && std::abs(step.theta()) < kSame;
}

OdometryBridge::Step OdometryBridge::follow(std::int64_t stamp, const PoseAt& T_odom_base,
                                            const std::optional<scan::ElapsedTime>& elapsed) {
  const auto now = T_odom_base(stamp);
  if (!now) return {T_path_base_, false};
  if (last_stamp_ && stamp <= *last_stamp_) {
    return {T_path_base_ * geometry::between(*T_odom_base_, *now), false};
  }
  bool is_whole = true;
  if (!T_odom_base_) {
    T_path_base_ = *now;
  } else if (last_stamp_) {
    is_whole = step(stamp, T_odom_base, elapsed);
  } else {
    // Nobody knows how long ago that was.
    is_whole = advance(*now, kBridge.pause);
  }
  T_odom_base_ = now;
  last_stamp_ = stamp;
  return {T_path_base_, !is_whole};
}

// Refuses a change of speed, too, that is spread over more than one stretch: transforms are read
// between two samples.
bool OdometryBridge::step(std::int64_t stamp, const PoseAt& T_odom_base,
                          const std::optional<scan::ElapsedTime>& time) {
  const Pose2 start = T_path_base_;
  const double stamped = secondsBetween(*last_stamp_, stamp);
  const double elapsed = time ? time->usual : stamped;
  const double longest = time ? std::max(time->longest, stamped) : stamped;
  bool is_whole = walk(stamp, T_odom_base, longest - stamped);
  if (velocity_) {
    const Pose2 expected = Pose2::exp(std::min(elapsed, kBridge.pause) * *velocity_);
    const Pose2 change = geometry::between(start * expected, T_path_base_);
    const double most = 0.5 * kBridge.acceleration * longest * longest + kBridge.position;
    if (change.translation().norm() > most) {
      T_path_base_ = start * expected;
      is_whole = false;
    }
  }
  velocity_ = geometry::between(start, T_path_base_).log() / elapsed;
  return is_whole;
}

// Goes stretch by stretch, so that a short break among motion is found, and costs no more of it.
// `slack` is the time that may have passed besides that of the stamps [s].
bool OdometryBridge::walk(std::int64_t stamp, const PoseAt& T_odom_base, double slack) {
  const std::int64_t begin = *last_stamp_;
  const std::int64_t stretches = stretchesBetween(begin, stamp);
  std::int64_t before = begin;
  bool is_whole = true;
  for (std::int64_t i = 1; i <= stretches; ++i) {
    const std::int64_t next = begin + (stamp - begin) * i / stretches;
    const auto pose = T_odom_base(next);
    if (!pose) continue;
    is_whole = advance(*pose, secondsBetween(before, next) + slack) && is_whole;
    before = next;
  }
  return is_whole;
}

bool OdometryBridge::advance(const Pose2& T_odom_base, double seconds) {
  const Pose2 moved = geometry::between(*T_odom_base_, T_odom_base);
  T_odom_base_ = T_odom_base;
  const bool is_possible = limits_.allow(moved, seconds);
  const Eigen::Vector3d velocity = velocity_.value_or(Eigen::Vector3d::Zero());
  T_path_base_ = T_path_base_ *
                 (is_possible ? moved : Pose2::exp(std::min(seconds, kBridge.pause) * velocity));
  return is_possible;
}

bool OdometryBridge::isContinuous(std::int64_t from, std::int64_t to,
                                  const PoseAt& T_odom_base) const {
  const std::int64_t stretches = stretchesBetween(from, to);
  const double seconds = secondsBetween(from, to) / static_cast<double>(stretches);
  auto before = T_odom_base(from);
  for (std::int64_t i = 1; i <= stretches && before; ++i) {
    const auto next = T_odom_base(from + (to - from) * i / stretches);
    if (!next || !limits_.allow(geometry::between(*before, *next), seconds)) return false;
    before = next;
  }
  return before.has_value();
}

}  // namespace sightline::pipeline
