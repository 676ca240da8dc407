#include "sightline/lines/merging.h"

#include <cmath>

#include "sightline/lines/beam_residuals.h"
#include "sightline/lines/chi_square.h"
#include "sightline/lines/normal_equations.h"

namespace sightline::lines {

namespace {

// χ² with two degrees of freedom, at the odds of a standard normal beyond ±sigmas.
double twoDofLimit(double sigmas) {
  return -2.0 * std::log(std::erfc(sigmas / std::sqrt(2.0)));
}

}  // namespace

double mahalanobisSquared(const LineEstimate& before, const LineEstimate& after, double position) {
  const double origin_x = before.rho * before.normal_x + position * before.alongX();
  const double origin_y = before.rho * before.normal_y + position * before.alongY();
  const double rho = after.rho - after.normal_x * origin_x - after.normal_y * origin_y;
  const double phi = before.normal_x * after.normal_y - before.normal_y * after.normal_x;
  const Information a = before.information.shifted(position);
  const Information b =
      after.information.shifted(after.alongX() * origin_x + after.alongY() * origin_y);
  const double da = 1.0 / a.determinant();
  const double db = 1.0 / b.determinant();
  const double rho_rho = da * a.phi_phi + db * b.phi_phi;
  const double rho_phi = -da * a.rho_phi - db * b.rho_phi;
  const double phi_phi = da * a.rho_rho + db * b.rho_rho;
  const double determinant = rho_rho * phi_phi - rho_phi * rho_phi;
  return (phi_phi * rho * rho - 2.0 * rho_phi * rho * phi + rho_rho * phi * phi) / determinant;
}

Merging::Merging(const BeamArray& beams, const LineExtractorConfig& config)
    : beams_(beams),
      gap_(config),
      gate_(config.gate),
      misfit_(config.misfit),
      distance_limit_(twoDofLimit(config.gate)) {}

bool Merging::merge(Piece& before, const Piece& after) const {
  const LineEstimate& line = before.line;
  if (line.normal_x * after.line.normal_x + line.normal_y * after.line.normal_y < 0.5) return false;
  const double position = positionOn(beams_, before.end - 1, line);
  const double next_position = positionOn(beams_, after.first, line);
  if (!gap_.mayBridge(beams_, before.end - 1, after.first, next_position - position)) return false;
  if (mahalanobisSquared(line, after.line, 0.5 * (position + next_position)) > distance_limit_) {
    return false;
  }
  Piece joined = before;
  joined.end = after.end;
  joined.beams = 0.0;  // to be refined in full
  if (after.beams > before.beams) joined.line = after.line;
  constexpr double kEverything = 1e12;
  NormalEquations both = linearise(beams_, before.first, before.end, joined.line, kEverything);
  both += linearise(beams_, after.first, after.end, joined.line, kEverything);
  stepTo(both, joined.line);
  if (!refine(beams_, gate_ * gate_, joined)) return false;
  if (joined.chi_square > chiSquareLimit(gate_, joined.beams - 2.0) * misfit_ * misfit_)
    return false;
  before = joined;
  return true;
}

}  // namespace sightline::lines
