#pragma once

#include <cstddef>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/line_estimate.h"

namespace sightline::lines {

/// A run of returns [first, end) and the line that explains them, stray ones apart.
struct Piece {
  std::size_t first = 0;
  std::size_t end = 0;
  LineEstimate line;
  std::size_t beams = 0;    ///< returns within the gate
  double chi_square = 0.0;  ///< of those
};

/// Sums of the Gauss-Newton step of pears eq. 37, each residual divided by its standard deviation.
struct NormalEquations {
  Information information;  ///< eq. 39
  double gradient_rho = 0.0;
  double gradient_phi = 0.0;
  double chi_square = 0.0;
  std::size_t beams = 0;
};

/// About a line, over the returns [first, end) whose squared residual is within `gate_squared`.
NormalEquations linearise(const BeamArray& beams, std::size_t first, std::size_t end,
                          const LineEstimate& line, double gate_squared);

/// Takes one Gauss-Newton step and the information with it. Returns the squared length of the step
/// in standard deviations: how much the sum of squares has fallen. The information has to be
/// determined.
double stepTo(const NormalEquations& equations, LineEstimate& line);

/// Maximum-likelihood line of the returns of a piece that lie within the gate (pears eq. 37). False
/// where they determine none.
bool refine(const BeamArray& beams, double gate_squared, Piece& piece);

}  // namespace sightline::lines
