#include "sightline/lines/normal_equations.h"

namespace sightline::lines {

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  information.rho_rho += other.information.rho_rho;
  information.rho_phi += other.information.rho_phi;
  information.phi_phi += other.information.phi_phi;
  gradient_rho += other.gradient_rho;
  gradient_phi += other.gradient_phi;
  chi_square += other.chi_square;
  beams += other.beams;
  return *this;
}

NormalEquations& NormalEquations::operator-=(const NormalEquations& other) {
  information.rho_rho -= other.information.rho_rho;
  information.rho_phi -= other.information.rho_phi;
  information.phi_phi -= other.information.phi_phi;
  gradient_rho -= other.gradient_rho;
  gradient_phi -= other.gradient_phi;
  chi_square -= other.chi_square;
  beams -= other.beams;
  return *this;
}

SIGHTLINE_VECTOR_CLONES
NormalEquations linearise(const BeamArray& beams, std::size_t first, std::size_t end,
                          const LineEstimate& line, double gate_squared) {
  if (first >= end) return {};
  NormalSums sums(positionOn(beams, first + (end - first) / 2, line));
  const auto gate = static_cast<float>(gate_squared);
  const auto add = [&](std::size_t i, const Packet& taken) {
    const BeamResiduals residuals = residualsOf(beams, i, line);
    const Packet squared = residuals.squared();
    sums.add(residuals, squared, squared <= gate ? taken : all(0.0F));
  };
  std::size_t i = first;
  for (; i + kLanes <= end; i += kLanes) add(i, all(1.0F));
  if (i < end) add(i, firstLanes(end - i));
  return sums.total();
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

}  // namespace sightline::lines
