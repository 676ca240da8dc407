#pragma once

#include <cstddef>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/line_estimate.h"
#include "sightline/lines/packet.h"

namespace sightline::lines {

/// Residuals of beams against a line.
///
/// With the beam from o along d ending in p, the predicted range is r̂ = (ρ − n·o) / (n·d), which is
/// pears eq. 27 for a sensor that has moved to o, and the innovation ν = r − r̂ = (n·p − ρ) / (n·d).
/// Everything is kept multiplied by n·d, where nothing divides by a grazing angle: the distance
/// e = n·p − ρ has the variance q = (n·d)² R, its derivatives are −1 by ρ and the position of the
/// predicted point along the line by φ (eq. 30).
struct BeamResiduals {
  Packet distance;  ///< e [m]
  Packet position;  ///< along the line, of the point where the beam meets it [m]
  Packet weight;    ///< 1/q [1/m²]

  /// e²/q = ν²/R.
  Packet squared() const { return distance * distance * weight; }
};

/// A beam closer to parallel than this sine measures nothing about the line.
constexpr float kMinIncidence = 0.01F;

/// Residuals of kLanes beams from a return on.
inline BeamResiduals residualsOf(const BeamArray& beams, std::size_t first,
                                 const LineEstimate& line) {
  const auto nx = static_cast<float>(line.normal_x);
  const auto ny = static_cast<float>(line.normal_y);
  const auto rho = static_cast<float>(line.rho);
  const Packet x = load(beams.x.data() + first);
  const Packet y = load(beams.y.data() + first);
  const Packet dx = load(beams.direction_x.data() + first);
  const Packet dy = load(beams.direction_y.data() + first);
  const Packet along_variance = load(beams.range_variance.data() + first);
  const Packet across_variance = load(beams.across_variance.data() + first);

  const Packet facing = nx * dx + ny * dy;
  const Packet c = larger(facing, all(kMinIncidence));
  const Packet s = nx * dy - ny * dx;
  Packet q = c * c * along_variance + s * s * across_variance;
  if (__builtin_expect(beams.has_jitter, false)) {
    q -= 2.0F * c * s * load(beams.cross_covariance.data() + first);
  }
  const Packet inverse = 1.0F / (c * q);
  const Packet e = nx * x + ny * y - rho;
  constexpr float kOffAnyLine = 1e6F;
  BeamResiduals result;
  result.distance = facing < kMinIncidence ? all(kOffAnyLine) : e;
  result.position = nx * y - ny * x - e * s * (q * inverse);
  result.weight = c * inverse;
  return result;
}

/// Whether a return is within a gate on its residual.
inline bool isWithin(const BeamArray& beams, std::size_t i, const LineEstimate& line,
                     float gate_squared) {
  return residualsOf(beams, i, line).squared()[0] <= gate_squared;
}

/// Position along the line at which a beam meets it [m].
inline double positionOn(const BeamArray& beams, std::size_t i, const LineEstimate& line) {
  return static_cast<double>(residualsOf(beams, i, line).position[0]);
}

}  // namespace sightline::lines
