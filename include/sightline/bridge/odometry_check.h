#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "sightline/logs/trajectory.h"

namespace sightline::logs {

/// What a recorded odometry is like.
struct OdometrySummary {
  std::size_t poses = 0;
  std::size_t refused = 0;                 ///< not finite, or 1000 km and more from the origin
  std::size_t jumps = 0;                   ///< steps that no carrier makes
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
  /// All but the refused.
  const Trajectory& poses() const { return poses_; }

 private:
  OdometrySummary summary_;
  Trajectory poses_;
};

}  // namespace sightline::logs
