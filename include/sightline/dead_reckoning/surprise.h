#pragma once

#include <cmath>

namespace sightline::dead_reckoning {

/// Logarithm of the odds of a pose that explains all of a scan against one that explains nothing of
/// it: some twenty things, the logarithm of twenty each.
constexpr double kNatsPerScan = 60.0;

/// Probability of a pose beside one that costs so much less, as a share of the scan.
inline double probabilityBeside(double cost) {
  return 1.0 / (1.0 + std::exp(kNatsPerScan * cost));
}

/// Cost of a pose that was not expected, as the share of a scan whose being left unexplained
/// counts as much: one pose explains more of a scan than another, the other is nearer to what was
/// expected, and both are weighed in the logarithm of their probability.
///
/// How much a carrier's motion surprises is learned from a few scans, so that the motion follows
/// Student's distribution. A scan shows some twenty things, doors, people, pieces of wall, each of
/// which a right pose explains with odds of twenty to one.
///
/// @param square  squared Mahalanobis distance from what was expected (3 degrees of freedom)
inline double surpriseCost(double square) {
  constexpr double kFreedom = 10.0;
  return 0.5 * (kFreedom + 3.0) / kNatsPerScan * std::log1p(square / kFreedom);
}

}  // namespace sightline::dead_reckoning
