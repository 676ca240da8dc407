#pragma once

#include "sightline/triangulation/projection_geometry.h"

namespace sightline::triangulation {

/// The laser beam as calibration takes it: Gaussian, and ending at its 1/e² points.
///
/// Share of its power, in [0, 1], on the side of an edge that it reaches over by `reach` [m] from
/// its axis; `width` [m] is that between the 1/e² points.
double powerBeyond(double reach, double width);

/// Effect of the width of the beam on the image of a flat target that stands across straight ahead.
/// Image position is not linear along the spot, and its nearer side returns more light, so that the
/// centroid of the light is not where the beam's axis alone would be seen. That is of second order
/// in the width: tenths of a micrometre.
struct SpotOnTarget {
  double shift = 0.0;        ///< of the centroid from the image of the axis [m]
  double half_length = 0.0;  ///< of the image, from that of the axis to its farther end [m]
};

/// `depth` [m] in the projection frame; the surface scatters by Lambert's law.
SpotOnTarget spotOnTarget(const ProjectionGeometry& geometry, double depth, double angle,
                          double beam_width);

}  // namespace sightline::triangulation
