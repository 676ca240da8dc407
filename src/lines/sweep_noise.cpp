#include "sightline/lines/sweep_noise.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/angle.h"
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

// ∂p by the sensor's coordinates (x, y, θ), of a point at `arm` from the sensor.
MotionSum::Response displacement(const Eigen::Vector2d& arm) {
  MotionSum::Response jacobian;
  jacobian << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  return jacobian;
}

void widenSigma(double& sigma, const Eigen::Matrix2d& covariance, const Eigen::Vector2d& along) {
  sigma = std::sqrt(sigma * sigma + along.dot(covariance * along));
}

}  // namespace

Eigen::Matrix2d MotionSum::covariance(const scan::MotionNoise& noise) {
  const auto isLater = [](const Term& a, const Term& b) { return a.time_ratio > b.time_ratio; };
  if (!std::is_sorted(terms_.begin(), terms_.end(), isLater)) {
    std::sort(terms_.begin(), terms_.end(), isLater);
  }
  Response all = Response::Zero();
  Response by_time = Response::Zero();
  Eigen::Matrix2d walked = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    all += terms_[i].response;
    by_time += terms_[i].time_ratio * terms_[i].response;
    const double before = i + 1 < terms_.size() ? terms_[i + 1].time_ratio : 0.0;
    walked += (terms_[i].time_ratio - before) * all * noise.walk * all.transpose();
  }
  return walked + by_time * noise.drift * by_time.transpose();
}

void SweepNoise::assign(const scan::Scan& scan, const BeamArray& beams) {
  scan_ = &scan;
  beams_ = &beams;
  is_zero_ = (scan.motion_noise.drift.isZero(0.0) && scan.motion_noise.walk.isZero(0.0)) ||
             !(scan.duration() > 0.0);
}

double SweepNoise::timeRatio(std::size_t beam) const {
  return std::max(0.0, scan_->geometry()->timeOffsets()[beam]) / scan_->duration();
}

Eigen::Matrix3d SweepNoise::ofMotion(double time_ratio) const {
  const scan::MotionNoise& noise = scan_->motion_noise;
  return time_ratio * time_ratio * noise.drift + time_ratio * noise.walk;
}

Eigen::Vector2d SweepNoise::origin(std::size_t beam) const {
  if (scan_->sensorMotion().empty()) return {0.0, 0.0};
  return scan_->sensorMotion()[beam].translation();
}

Eigen::Matrix2d SweepNoise::ofPoint(const Eigen::Vector2d& point, std::size_t beam) const {
  const MotionSum::Response jacobian = displacement(point - origin(beam));
  return jacobian * ofMotion(timeRatio(beam)) * jacobian.transpose();
}

double SweepNoise::ofPrediction(const LineEstimate& line, std::size_t from, std::size_t to) const {
  const std::size_t beam = beams_->beam[to] % scan_->beams();
  const Eigen::Vector2d normal(line.normal_x, line.normal_y);
  const Eigen::RowVector3d across =
      normal.transpose() * displacement(scan_->point(beam) - origin(beam));
  const double passed = std::abs(timeRatio(beam) - timeRatio(beams_->beam[from] % scan_->beams()));
  return across * ofMotion(passed) * across.transpose();
}

// An error of the motion that moves beam i by nᵢ·dpᵢ across the line moves the estimate by
// A⁻¹ Σ wᵢ hᵢ nᵢ·dpᵢ, with the information A, the weights w and the derivatives h of the residuals.
void SweepNoise::addTo(const Piece& piece, const Eigen::Matrix2d& jacobian, double gate_squared) {
  const Eigen::Matrix2d gain = jacobian * inverse(piece.line.information);
  const Eigen::Vector2d normal(piece.line.normal_x, piece.line.normal_y);
  for (std::size_t i = piece.end; i-- > piece.first;) {
    const BeamResiduals residuals = residualsOf(*beams_, i, piece.line);
    if (static_cast<double>(residuals.squared()[0]) > gate_squared) continue;
    const std::size_t beam = beams_->beam[i] % scan_->beams();
    const Eigen::RowVector3d across =
        normal.transpose() * displacement(scan_->point(beam) - origin(beam));
    const Eigen::Vector2d answer =
        gain * Eigen::Vector2d(-1.0, static_cast<double>(residuals.position[0]));
    sum_.add(timeRatio(beam), static_cast<double>(residuals.weight[0]) * answer * across);
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

void SweepNoise::widen(geometry::Arc& arc) const {
  const std::size_t count = scan_->beams();
  const std::size_t length = (arc.last_beam + count - arc.first_beam) % count;
  arc.covariance.topLeftCorner<2, 2>() +=
      ofPoint(arc.centre, (arc.first_beam + length / 2) % count);
}

}  // namespace sightline::lines
