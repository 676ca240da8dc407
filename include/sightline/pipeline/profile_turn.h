#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"

namespace sightline::pipeline {

/// Return of a scan, and its place in the order of the beams.
struct OrderedReturn {
  Eigen::Vector2d point;  ///< in the sensor [m]
  double place = 0.0;     ///< 0 of the first beam to 1 of the last
};

/// Returns of every few beams, by the directions of the beams alone: where the sensor moved within
/// the sweep does not matter.
std::vector<OrderedReturn> orderedReturns(const scan::Scan& scan);

/// Difference between a range that was seen and the one that returns of a scan before predict.
struct TurnResidual {
  double difference = 0.0;  ///< seen less predicted [m]
  double slope = 0.0;       ///< of the range over the angle, which a turn multiplies with [m/rad]
  double place = 0.0;       ///< of the beam in its sweep, 0 to 1
  double places = 0.0;      ///< how much later in its sweep the beam is than the one before
};

/// Turn of a sensor between two of its scans by their ranges.
struct ProfileTurn {
  double beyond = 0.0;                  ///< the predicted one, counter-clockwise [rad]
  std::vector<TurnResidual> residuals;  ///< with that turn
};

/// Finds the turn by which the ranges of a scan are the most like those that the scan before makes
/// one expect. Nothing where that is not determined to half a degree.
///
/// @param T_before_now  predicted motion of the sensor; its turn may be off by a quarter of a
///                      radian
/// @param sweep_turn    turn within a sweep, as far as that is believed to be known [rad]
std::optional<ProfileTurn> turnBetween(const std::vector<OrderedReturn>& before,
                                       const scan::Scan& now, const geometry::Pose2& T_before_now,
                                       double sweep_turn);

}  // namespace sightline::pipeline
