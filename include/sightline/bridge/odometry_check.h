#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "sightline/logs/trajectory.h"
#include "sightline/pipeline/odometry_bridge.h"

namespace sightline::bridge {

/// What a recorded odometry is like.
struct OdometrySummary {
  std::size_t poses = 0;
  std::size_t jumps = 0;                   ///< steps that OdometryLimits do not allow
  std::optional<std::int64_t> first_jump;  ///< stamp behind it [ns]
  double distance = 0.0;                   ///< without the jumps [m]
  double turned = 0.0;                     ///< sum of turns without their signs [rad]
};

/// Gathers the poses of an odometry.
class OdometryCheck {
 public:
  /// T_odom_base at a stamp [ns]; stamps that do not rise are left out.
  void add(std::int64_t stamp, const geometry::Pose2& pose);
  const OdometrySummary& summary() const { return summary_; }
  const logs::Trajectory& poses() const { return poses_; }

 private:
  pipeline::OdometryLimits limits_;
  OdometrySummary summary_;
  logs::Trajectory poses_;
};

}  // namespace sightline::bridge
