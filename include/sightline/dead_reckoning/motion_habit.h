#pragma once

#include <Eigen/Core>

#include "sightline/dead_reckoning/dead_reckoner_config.h"

namespace sightline::dead_reckoning {

/// Learns how a carrier really moves: how much its velocity changes from scan to scan, and how fast
/// it gets. A surprise counts at once and fades over a score of scans, so that a robot on wheels
/// and a person need no settings of their own.
class MotionHabit {
 public:
  /// @param limits  what the carrier is capable of
  explicit MotionHabit(const CarrierConfig& limits) : limits_(limits) { reset(); }

  void reset();
  /// Takes the twist [m/s, m/s, rad/s] that was found, and the one that was expected.
  /// @param measured  shares of translation and heading that were measured and not predicted,
  ///                  [0, 1]: along a bare corridor the twist is found to be what was expected,
  ///                  which is no sign of a carrier that goes on evenly
  void learn(const Eigen::Vector3d& expected, const Eigen::Vector3d& twist, double elapsed,
             const Eigen::Vector2d& measured = Eigen::Vector2d::Ones());

  /// What the carrier is expected to do: no more than it is capable of.
  CarrierConfig expected() const;

 private:
  CarrierConfig limits_;
  Eigen::Vector2d change_;  // rms of the change of velocity [m/s², rad/s²]
  Eigen::Vector2d speed_;   // [m/s, rad/s]
};

}  // namespace sightline::dead_reckoning
