#pragma once

#include <optional>
#include <vector>

#include "sightline/triangulation/calibration_residuals.h"

namespace sightline::triangulation {

// Start of a joint fit: linear least squares, exact on readings without noise.

/// Origin and projected vergence from edges seen at known places. With t the tangent of the scan
/// angle and T that of the vergence, y = y₀ + (z − x₀) tan(θ + γᵖ) is
///
///     y − z t = T (z + y t) + (y₀ − x₀ T) − t (x₀ + y₀ T)
///
/// Nothing where the edges do not determine all three.
std::optional<ScanOrigin> startOrigin(const std::vector<StripeEdge>& edges);

/// f, d, γ and s from images and the origin (pears eqs 11-13). The six entries of eq. 13 hold four
/// unknowns: d is the first, s the third, f the fourth over the first and tan γ the second over the
/// first. As p stands on both sides of eq. 11, what noise makes of it is biased. Nothing where the
/// images do not determine all six; the outcome may be outside of any sensor's range.
std::optional<Intrinsics> startIntrinsics(const std::vector<ImageReading>& images,
                                          const ScanOrigin& origin, double detector_length);

}  // namespace sightline::triangulation
