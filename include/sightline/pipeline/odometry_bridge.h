#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <Eigen/Core>

#include "sightline/config/fields.h"
#include "sightline/geometry/pose2.h"
#include "sightline/scan/elapsed_time.h"

namespace sightline::pipeline {

/// Speed that no wheeled carrier of a planar scanner has: what odometry reports beyond it is a
/// break in the odometry, not motion.
struct OdometryLimits {
  double max_speed = 5.0;      ///< [m/s]
  double max_turn_rate = 6.0;  ///< [rad/s]

  void visit(config::FieldVisitor& visitor);
  /// Whether the carrier can have moved like this in so many seconds, but for what odometry is off
  /// by in a moment.
  bool allow(const geometry::Pose2& step, double seconds) const;
};

/// Whether a carrier can have got from one place to the other while its clock was set. Where the
/// odometry is elsewhere after that, a recording is played again.
bool isSamePlace(const geometry::Pose2& before, const geometry::Pose2& after);

/// Path of the wheels from scan to scan, on which breaks in the odometry are bridged: it was reset,
/// it leaped. Over a break the carrier is taken to go on as it did before.
class OdometryBridge {
 public:
  /// T_odom_base at a time [ns], as reported.
  using PoseAt = std::function<std::optional<geometry::Pose2>(std::int64_t)>;
  struct Step {
    geometry::Pose2 T_path_base;  ///< in the frame in which the odometry began
    bool is_broken = false;       ///< since the time that was asked for before
  };

  explicit OdometryBridge(const OdometryLimits& limits) : limits_(limits) {}

  /// Follows the odometry to a time at which it is known. A time before the last one is read on
  /// from there. `elapsed` is the time since the last one where the stamps do not tell it.
  Step follow(std::int64_t stamp, const PoseAt& T_odom_base,
              const std::optional<scan::ElapsedTime>& elapsed = {});
  /// The clock was set: the path goes on where the odometry does.
  void restartClock() { last_stamp_.reset(); }
  /// Whether the carrier can have moved between two times as the odometry says.
  bool isContinuous(std::int64_t from, std::int64_t to, const PoseAt& T_odom_base) const;

 private:
  bool step(std::int64_t stamp, const PoseAt& T_odom_base,
            const std::optional<scan::ElapsedTime>& elapsed);
  bool walk(std::int64_t stamp, const PoseAt& T_odom_base, double slack);
  bool advance(const geometry::Pose2& T_odom_base, double seconds);

  OdometryLimits limits_;
  std::optional<std::int64_t> last_stamp_;
  std::optional<geometry::Pose2> T_odom_base_;  // at the end of the path, as reported
  geometry::Pose2 T_path_base_;
  std::optional<Eigen::Vector3d> velocity_;  // of the last step, in the base
};

}  // namespace sightline::pipeline
