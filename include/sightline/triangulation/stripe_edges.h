#pragma once

#include <vector>

#include "sightline/triangulation/calibration_recording.h"

namespace sightline::triangulation {

/// Change of a scan from a dark to a bright stripe or back: at this scan angle the axis of the beam
/// meets a place whose lateral position is known.
struct StripeEdge {
  double depth = 0.0;       ///< [m], sensor frame
  double y = 0.0;           ///< [m], of the edge in the sensor frame
  double scan_angle = 0.0;  ///< [rad], without the projected vergence
  double sigma = 0.0;       ///< standard deviation of the scan angle [rad]
};

/// Edges of a striped target, from left to right in the scan. The width of the beam blurs an edge
/// over the beams that meet it; their currents, each with the noise I_n / √readings, give its
/// place to a fraction of the beams' spacing. Where beams are so far apart that none meets the
/// edge, it is no better known than the gap between them is wide, and `sigma` says so.
///
/// Which edge it is follows from the nominal origin in `sensor`, which therefore has to be right to
/// within a stripe. Edges too near to the next one, or to the end of the field, are left out.
std::vector<StripeEdge> findStripeEdges(const TargetPlacement& target,
                                        const SensorParameters& sensor, double beam_width);

}  // namespace sightline::triangulation
