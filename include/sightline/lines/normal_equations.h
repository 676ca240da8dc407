#pragma once

#include <cstddef>

#include "sightline/lines/beam_array.h"
#include "sightline/lines/beam_residuals.h"
#include "sightline/lines/line_estimate.h"

namespace sightline::lines {

/// Sums of the Gauss-Newton step of pears eq. 37, each residual divided by its standard deviation.
struct NormalEquations {
  Information information;  ///< eq. 39
  double gradient_rho = 0.0;
  double gradient_phi = 0.0;
  double chi_square = 0.0;
  double beams = 0.0;

  NormalEquations& operator+=(const NormalEquations& other);
  NormalEquations& operator-=(const NormalEquations& other);
};

/// The sums, lane by lane. Positions are taken from one in the midst of the beams, or their squares
/// would drown in the rounding of floats.
class NormalSums {
 public:
  explicit NormalSums(double reference) : reference_(static_cast<float>(reference)) {}

  /// Adds beams, each times `taken` (0 or 1).
  void add(const BeamResiduals& residuals, const Packet& squared, const Packet& taken) {
    const Packet w = taken * residuals.weight;
    const Packet a = residuals.position - reference_;
    const Packet wa = w * a;
    w_ += w;
    wa_ += wa;
    waa_ += wa * a;
    we_ += w * residuals.distance;
    wae_ += wa * residuals.distance;
    chi_square_ += taken * squared;
    beams_ += taken;
  }

  NormalEquations total() const {
    const Information about_reference{sum(w_), -sum(wa_), sum(waa_)};
    const double gradient_rho = -sum(we_);
    return {about_reference.shifted(-static_cast<double>(reference_)), gradient_rho,
            sum(wae_) - static_cast<double>(reference_) * gradient_rho, sum(chi_square_),
            sum(beams_)};
  }

 private:
  float reference_;
  Packet w_{}, wa_{}, waa_{}, we_{}, wae_{}, chi_square_{}, beams_{};
};

/// About a line, over the returns [first, end) whose squared residual is within `gate_squared`.
NormalEquations linearise(const BeamArray& beams, std::size_t first, std::size_t end,
                          const LineEstimate& line, double gate_squared);

/// Takes one Gauss-Newton step and the information with it. Returns the squared length of the step
/// in standard deviations: how much the sum of squares has fallen. The information has to be
/// determined.
double stepTo(const NormalEquations& equations, LineEstimate& line);

}  // namespace sightline::lines
