#pragma once

#include <algorithm>
#include <cstddef>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/line_estimate.h"

namespace sightline::lines {

/// How kLanes beams in a row lie to a line.
///
/// With the beam from o along d ending in p, the predicted range is r̂ = (ρ − n·o) / (n·d), which is
/// pears eq. 27 for a sensor that has moved to o, and the innovation ν = r − r̂ = (n·p − ρ) / (n·d).
/// Everything is kept multiplied by n·d, where nothing divides by a grazing angle: the distance
/// e = n·p − ρ has the variance q = (n·d)² R, its derivatives are −1 by ρ and the position of the
/// predicted point along the line by φ (eq. 30).
struct BeamResiduals {
  double distance[kLanes];  ///< e [m]
  double position[kLanes];  ///< along the line, of the point where the beam meets it [m]
  double weight[kLanes];    ///< 1/q [1/m²]
};

/// A beam closer to parallel than this sine measures nothing about the line.
constexpr double kMinIncidence = 0.01;

inline BeamResiduals residualsOf(const BeamArray& beams, std::size_t first,
                                 const LineEstimate& line) {
  const double nx = line.normal_x;
  const double ny = line.normal_y;
  const double* x = beams.x.data() + first;
  const double* y = beams.y.data() + first;
  const double* dx = beams.direction_x.data() + first;
  const double* dy = beams.direction_y.data() + first;
  const double* along_variance = beams.range_variance.data() + first;
  const double* across_variance = beams.across_variance.data() + first;
  BeamResiduals result;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double facing = nx * dx[i] + ny * dy[i];
    const double c = std::max(facing, kMinIncidence);
    const double s = nx * dy[i] - ny * dx[i];
    const double q = c * c * along_variance[i] + s * s * across_variance[i];
    const double inverse = 1.0 / (c * q);
    const double e = nx * x[i] + ny * y[i] - line.rho;
    result.distance[i] = facing < kMinIncidence ? 1e3 : e;
    result.position[i] = nx * y[i] - ny * x[i] - e * s * (q * inverse);
    result.weight[i] = c * inverse;
  }
  return result;
}

}  // namespace sightline::lines
