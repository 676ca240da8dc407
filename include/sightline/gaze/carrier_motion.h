#pragma once

#include <cstdint>
#include <optional>

#include "sightline/geometry/pose2.h"
#include "sightline/motion/pose_history.h"

namespace sightline::gaze {

/// Motion of the carrier by its odometry, and for a moment beyond the newest report. Times are
/// [ns].
class CarrierMotion {
 public:
  /// Odometry older than `patience` [s] is not fresh.
  explicit CarrierMotion(double patience) : patience_(patience) {}

  void add(std::int64_t stamp, const geometry::Pose2& T_odom_base);
  void clear() { history_.clear(); }

  bool isFresh(std::int64_t now) const;
  /// Pose as of the newest report.
  std::optional<geometry::Pose2> newest() const;
  /// Pose at a time; beyond the newest report by constant velocity, as long as that is fresh.
  std::optional<geometry::Pose2> at(std::int64_t stamp) const;
  /// Velocity in the frame of the base [m/s, m/s, rad/s].
  Eigen::Vector3d twist() const;

 private:
  motion::PoseHistory history_;
  double patience_;
};

}  // namespace sightline::gaze
