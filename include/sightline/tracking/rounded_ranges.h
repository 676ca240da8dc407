#pragma once

#include <vector>

#include "sightline/fitting/line_fit.h"
#include "sightline/tracking/beam_points.h"

/// Walls read by a scanner that rounds its ranges, such as one whose clock counts 50 mm (jensfelt
/// section 2): neighbours that read the same have been rounded alike.
namespace sightline::tracking {

/// Share by which the variance of a line grows that is fitted to all points as if their errors were
/// independent. The residuals of a wall that is read in m steps are a saw of m teeth, of amplitude
/// A and all inclined to the same side: over a length L its slope is off by 2 A / (L m), where
/// independent errors of n beams would make it 2 A / (L √n); a wall that is one step long is off by
/// up to A. None where no neighbours read the same, or where noise beyond the rounding makes that a
/// coincidence: steps are √12 of the sigma of a beam whose only noise is the rounding, and less of
/// others.
double roundedAlike(const std::vector<const BeamPoint*>& points);

/// Places where the readings go from one step to the next: there the range is known to the jitter
/// of the beams, whatever they are rounded to, and the fit is free of the saw.
std::vector<fitting::NoisyPoint> stepEdges(const std::vector<const BeamPoint*>& points);

}  // namespace sightline::tracking
