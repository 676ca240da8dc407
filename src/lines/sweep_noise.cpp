#include "sightline/lines/sweep_noise.h"

#include <cmath>

#include "sightline/geometry/angle.h"
#include "sightline/lines/beam_motion.h"
#include "sightline/lines/beam_residuals.h"

namespace sightline::lines {

namespace {

Eigen::Matrix2d inverse(const Information& information) {
  Eigen::Matrix2d covariance;
  covariance << information.phi_phi, -information.rho_phi, -information.rho_phi,
      information.rho_rho;
  return covariance / information.determinant();
}

// ∂(ρ, φ) by (ρ, φ) where the frame's origin moves along the line by `position`.
Eigen::Matrix2d seenFrom(double position) {
  Eigen::Matrix2d jacobian;
  jacobian << 1.0, -position, 0.0, 1.0;
  return jacobian;
}

void widenSigma(double& sigma, const Eigen::Matrix2d& covariance, const Eigen::Vector2d& along) {
  sigma = std::sqrt(sigma * sigma + along.dot(covariance * along));
}

}  // namespace

void SweepNoise::assign(const scan::Scan& scan, const BeamArray& beams) {
  scan_ = &scan;
  beams_ = &beams;
  is_zero_ = (scan.motion_noise.drift.isZero(0.0) && scan.motion_noise.walk.isZero(0.0)) ||
             !(scan.duration() > 0.0);
}

Eigen::Matrix2d SweepNoise::ofPoint(const Eigen::Vector2d& point, std::size_t beam) const {
  const Eigen::Matrix<double, 2, 3> jacobian = motionJacobian(*scan_, beam, point);
  return jacobian * motionCovariance(*scan_, beam) * jacobian.transpose();
}

Eigen::RowVector3d SweepNoise::acrossLine(const LineEstimate& line, std::size_t beam) const {
  const Eigen::RowVector2d normal(line.normal_x, line.normal_y);
  return normal * motionJacobian(*scan_, beam, scan_->point(beam));
}

// An error of the motion that moves beam i by nᵢ·dpᵢ across the line moves the estimate by
// A⁻¹ Σ wᵢ hᵢ nᵢ·dpᵢ, with the information A, the weights w and the derivatives h of the residuals.
void SweepNoise::addTo(const Piece& piece, const Eigen::Matrix2d& jacobian, double gate_squared) {
  const Eigen::Matrix2d gain = jacobian * inverse(piece.line.information);
  for (std::size_t i = piece.end; i-- > piece.first;) {
    const BeamResiduals residuals = residualsOf(*beams_, i, piece.line);
    if (static_cast<double>(residuals.squared()[0]) > gate_squared) continue;
    const std::size_t beam = beams_->beam[i] % scan_->beams();
    const Eigen::RowVector3d across = acrossLine(piece.line, beam);
    const Eigen::Vector2d answer =
        gain * Eigen::Vector2d(-1.0, static_cast<double>(residuals.position[0]));
    sum_.add(timeRatio(*scan_, beam), static_cast<double>(residuals.weight[0]) * answer * across);
  }
}

Eigen::Matrix2d SweepNoise::ofLine(const Piece& piece, double gate_squared) {
  sum_.clear();
  addTo(piece, Eigen::Matrix2d::Identity(), gate_squared);
  return sum_.covariance(scan_->motion_noise);
}

Eigen::Matrix2d SweepNoise::ofDifference(const Piece& before, const Piece& after, double position,
                                         double gate_squared) {
  const LineEstimate& line = before.line;
  const Eigen::Vector2d place(line.rho * line.normal_x + position * line.alongX(),
                              line.rho * line.normal_y + position * line.alongY());
  const double on_after = after.line.alongX() * place.x() + after.line.alongY() * place.y();
  sum_.clear();
  addTo(after, seenFrom(on_after), gate_squared);
  addTo(before, -seenFrom(position), gate_squared);
  return sum_.covariance(scan_->motion_noise);
}

// An end moves as the beam does that saw it.
void SweepNoise::widen(const Piece& piece, double gate_squared, geometry::LineSegment& segment) {
  Eigen::Matrix2d of_line = ofLine(piece, gate_squared);
  const bool is_turned_round =
      segment.line.normal().dot(Eigen::Vector2d(piece.line.normal_x, piece.line.normal_y)) < 0.0;
  if (is_turned_round) of_line(0, 1) = of_line(1, 0) = -of_line(0, 1);
  segment.line.covariance += of_line;
  const Eigen::Vector2d along = segment.line.direction();
  widenSigma(segment.start_sigma, ofPoint(segment.ends.start, segment.first_beam), along);
  widenSigma(segment.end_sigma, ofPoint(segment.ends.end, segment.last_beam), along);
}

}  // namespace sightline::lines
