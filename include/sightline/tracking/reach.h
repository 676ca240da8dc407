#pragma once

#include <vector>

#include "sightline/geometry/polar_line.h"
#include "sightline/tracking/beam_points.h"

namespace sightline::tracking {

/// The points at whose beams a line lies within the reach of the sensor whatever their noise does.
/// Near a limit only those beams return anything whose noise brought them inside: they pull a line
/// that crosses the limit away from it.
///
/// @param line    in the base frame
/// @param sigmas  of the range that are kept from the limits
std::vector<const BeamPoint*> withinReach(const std::vector<const BeamPoint*>& points,
                                          const geometry::PolarLine& line, const Reach& reach,
                                          double sigmas);

}  // namespace sightline::tracking
