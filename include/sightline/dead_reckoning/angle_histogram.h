#pragma once

#include <cstddef>
#include <vector>

#include "sightline/dead_reckoning/surface_points.h"

namespace sightline::dead_reckoning {

/// Counts how often each direction occurs between points `skip` beams apart (saarinen alg. 6, step
/// 2). Directions are those of lines, without a sense: bins go over half a turn, as the arc tangent
/// of the source does, and a wall counts alike from whichever end it is seen.
std::vector<double> angleHistogram(const std::vector<SurfacePoint>& points, std::size_t skip,
                                   std::size_t bins);

/// A turn of the scan against the reference, and how well their histograms agree there.
struct HeadingCandidate {
  double heading = 0.0;  ///< [rad]
  double correlation = 0.0;
};

/// The local maxima of the circular cross-correlation S(k) = Σ h0(i) h(i + k) (eq. 4.7) within
/// `half_width` [rad] of `centre` [rad], best first. A point that turns by θ with the sensor is
/// seen at −θ: the scan's histogram is the reference's, shifted back by the heading.
std::vector<HeadingCandidate> correlateHistograms(const std::vector<double>& reference,
                                                  const std::vector<double>& scan, double centre,
                                                  double half_width);

}  // namespace sightline::dead_reckoning
