#include "sightline/lines/merging.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/statistics.h"
#include "sightline/lines/beam_residuals.h"
#include "sightline/lines/normal_equations.h"

namespace sightline::lines {

namespace {

// Difference of two lines in (ρ, φ), and the information about either, seen from a place on the
// first.
struct Difference {
  Difference(const LineEstimate& before, const LineEstimate& after, double position) {
    const double x = before.rho * before.normal_x + position * before.alongX();
    const double y = before.rho * before.normal_y + position * before.alongY();
    rho = after.rho - after.normal_x * x - after.normal_y * y;
    phi = before.normal_x * after.normal_y - before.normal_y * after.normal_x;
    of_before = before.information.shifted(position);
    of_after = after.information.shifted(after.alongX() * x + after.alongY() * y);
  }

  double rho;
  double phi;
  Information of_before;
  Information of_after;
};

// Kalman update of the first line with the second line for the observation.
NormalEquations fusion(const LineEstimate& before, const LineEstimate& after, double position) {
  const Difference d(before, after, position);
  NormalEquations both;
  both.gradient_rho = -(d.of_after.rho_rho * d.rho + d.of_after.rho_phi * d.phi);
  both.gradient_phi =
      -(d.of_after.rho_phi * d.rho + d.of_after.phi_phi * d.phi) - position * both.gradient_rho;
  both.information = d.of_before;
  both.information += d.of_after;
  both.information = both.information.shifted(-position);
  return both;
}

}  // namespace

double mahalanobisSquared(const LineEstimate& before, const LineEstimate& after, double position,
                          const Eigen::Matrix2d& other_noise) {
  const Difference d(before, after, position);
  const double da = 1.0 / d.of_before.determinant();
  const double db = 1.0 / d.of_after.determinant();
  const double rho_rho = da * d.of_before.phi_phi + db * d.of_after.phi_phi + other_noise(0, 0);
  const double rho_phi = -da * d.of_before.rho_phi - db * d.of_after.rho_phi + other_noise(0, 1);
  const double phi_phi = da * d.of_before.rho_rho + db * d.of_after.rho_rho + other_noise(1, 1);
  const double determinant = rho_rho * phi_phi - rho_phi * rho_phi;
  return (phi_phi * d.rho * d.rho - 2.0 * rho_phi * d.rho * d.phi + rho_rho * d.phi * d.phi) /
         determinant;
}

Merging::Merging(const BeamArray& beams, SweepNoise& sweep_noise, const LineExtractorConfig& config)
    : beams_(beams),
      sweep_noise_(sweep_noise),
      gap_(config),
      gate_(config.gate),
      chi_square_ratio_(config.misfit),
      distance_limit_(geometry::chiSquareLimitOf2(config.gate)) {}

bool Merging::mayBeOne(const Piece& before, const Piece& after, double position, double gap) const {
  Eigen::Matrix2d other = Eigen::Matrix2d::Zero();
  other.diagonal() = shape_.difference(lengthOf(before), lengthOf(after), std::max(0.0, gap));
  if (!sweep_noise_.isZero()) {
    other += sweep_noise_.ofDifference(before, after, position, gate_ * gate_);
  }
  return mahalanobisSquared(before.line, after.line, position, other) <= distance_limit_;
}

double Merging::lengthOf(const Piece& piece) const {
  constexpr double kLeast = 1e-3;  // m
  return std::max(kLeast, extent(beams_, piece));
}

// Whether the returns between two are on the line, but for a stray one here and there: a place that
// is a line of its own by little, and too short to be a wall, is no gap.
bool Merging::goesOn(const LineEstimate& line, std::size_t last, std::size_t next) const {
  const auto gate_squared = static_cast<float>(gate_ * gate_);
  for (std::size_t i = last + 1; i <= next; ++i) {
    if (i < next && !isWithin(beams_, i, line, gate_squared)) continue;
    const double length = positionOn(beams_, i, line) - positionOn(beams_, last, line);
    if (i - last > 2 || !gap_.mayBridge(beams_, line, last, i, length)) return false;
    last = i;
  }
  return true;
}

bool Merging::merge(Piece& before, const Piece& after) const {
  const LineEstimate& line = before.line;
  if (line.normal_x * after.line.normal_x + line.normal_y * after.line.normal_y < 0.5) return false;
  const double position = positionOn(beams_, before.end - 1, line);
  const double next_position = positionOn(beams_, after.first, line);
  const double length = next_position - position;
  const double between = 0.5 * (position + next_position);
  if (!mayBeOne(before, after, between, length)) return false;
  Piece joined = before;
  joined.end = after.end;
  joined.beams = 0.0;  // to be refined in full
  stepTo(fusion(line, after.line, between), joined.line);
  if (!gap_.mayBridge(beams_, line, before.end - 1, after.first, length) &&
      !goesOn(joined.line, before.end - 1, after.first)) {
    return false;
  }
  if (!refine(beams_, gate_ * gate_, joined)) return false;
  if (joined.chi_square >
      geometry::chiSquareLimit(gate_, joined.beams - 2.0) * chi_square_ratio_ * chi_square_ratio_)
    return false;
  before = joined;
  return true;
}

}  // namespace sightline::lines
