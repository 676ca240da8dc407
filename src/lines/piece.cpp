#include "sightline/lines/piece.h"

#include <algorithm>

#include "sightline/lines/beam_residuals.h"

namespace sightline::lines {

namespace {

constexpr int kMaxSteps = 10;
// A step this far below the standard deviations [σ²] leaves an error of second order in it.
constexpr double kSmallStep = 1e-2;

struct LaneSums {
  double w[kLanes] = {};
  double wa[kLanes] = {};
  double waa[kLanes] = {};
  double we[kLanes] = {};
  double wae[kLanes] = {};
  double wee[kLanes] = {};
  double count[kLanes] = {};

  void add(const BeamResiduals& residuals, double gate_squared, std::size_t lanes) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double e = residuals.distance[i];
      const double a = residuals.position[i];
      const double squared = e * e * residuals.weight[i];
      const double inside = (squared <= gate_squared) & (i < lanes) ? 1.0 : 0.0;
      const double weight = inside * residuals.weight[i];
      w[i] += weight;
      wa[i] += weight * a;
      waa[i] += weight * a * a;
      we[i] += weight * e;
      wae[i] += weight * a * e;
      wee[i] += inside * squared;
      count[i] += inside;
    }
  }
};

double total(const double (&lanes)[kLanes]) {
  double sum = 0.0;
  for (const double lane : lanes) sum += lane;
  return sum;
}

}  // namespace

NormalEquations linearise(const BeamArray& beams, std::size_t first, std::size_t end,
                          const LineEstimate& line, double gate_squared) {
  LaneSums sums;
  for (std::size_t i = first; i < end; i += kLanes) {
    sums.add(residualsOf(beams, i, line), gate_squared, end - i);
  }
  NormalEquations equations;
  equations.information = {total(sums.w), -total(sums.wa), total(sums.waa)};
  equations.gradient_rho = -total(sums.we);
  equations.gradient_phi = total(sums.wae);
  equations.chi_square = total(sums.wee);
  equations.beams = static_cast<std::size_t>(total(sums.count));
  return equations;
}

double stepTo(const NormalEquations& equations, LineEstimate& line) {
  const Information& info = equations.information;
  const double scale = -1.0 / info.determinant();
  const double rho_step =
      scale * (info.phi_phi * equations.gradient_rho - info.rho_phi * equations.gradient_phi);
  const double phi_step =
      scale * (info.rho_rho * equations.gradient_phi - info.rho_phi * equations.gradient_rho);
  line.information = info;
  line.step(rho_step, phi_step);
  return -(rho_step * equations.gradient_rho + phi_step * equations.gradient_phi);
}

bool refine(const BeamArray& beams, double gate_squared, Piece& piece) {
  for (int i = 0; i < kMaxSteps; ++i) {
    const NormalEquations equations =
        linearise(beams, piece.first, piece.end, piece.line, gate_squared);
    if (equations.beams < 3 || !equations.information.isDetermined()) return false;
    const double fallen = stepTo(equations, piece.line);
    piece.beams = equations.beams;
    piece.chi_square = std::max(0.0, equations.chi_square - fallen);
    if (fallen < kSmallStep) break;
  }
  return true;
}

}  // namespace sightline::lines
