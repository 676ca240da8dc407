#include "sightline/lines/feature_hypothesis.h"

#include <cmath>

#include <Eigen/LU>

#include "sightline/geometry/angle.h"

namespace sightline::lines {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::Vector2d;

// How things slide that slide. The border of a shadow moves along its wall by the ratio of the
// distances behind and in front of what throws it, the other way than the sensor.
constexpr struct {
  double ratio_sigma = 1.5;
  // Change of that ratio, after a way of one metre across the bearing.
  double ratio_walk = 1.0;
  // What else it does, a share of the sensor's way across the bearing.
  double unsteadiness = 0.2;
} kSliding;

constexpr int kX = 0, kScale = 2, kRatio = 2, kOffset = 3;

}  // namespace

double FeatureHypothesis::Innovation::nis() const {
  return residual.dot(covariance.inverse() * residual);
}

double FeatureHypothesis::Innovation::density() const {
  return std::exp(-0.5 * nis()) / (2.0 * geometry::kPi * std::sqrt(covariance.determinant()));
}

FeatureHypothesis::Response FeatureHypothesis::responseOf(const Sighting& sighting) const {
  Response response = Response::Zero();
  response.leftCols<2>().setIdentity();
  if (!isMoving()) response.col(kOffset) = sighting.along;
  return response;
}

Matrix2d FeatureHypothesis::noiseOf(const Sighting& sighting) const {
  return isMoving() ? sighting.fullCovariance() : sighting.covariance;
}

void FeatureHypothesis::start(const Sighting& sighting) {
  along_ = sighting.along;
  between_beams_ = sighting.between_beams;
  state_ << sighting.position, 0.0, 0.0;
  covariance_.setZero();
  covariance_.topLeftCorner<2, 2>() = sighting.fullCovariance();
  if (isMoving()) {
    const double variance = config_->speed_sigma * config_->speed_sigma;
    covariance_.bottomRightCorner<2, 2>() = variance * Matrix2d::Identity();
    return;
  }
  const double third = isSliding() ? kSliding.ratio_sigma : config_->odometry.scale_sigma;
  covariance_(kScale, kScale) = third * third;
  // The offset is part of where the end was seen.
  covariance_(kOffset, kOffset) = between_beams_;
  covariance_.col(kOffset).head<2>() = -between_beams_ * along_;
  covariance_.row(kOffset).head<2>() = -between_beams_ * along_.transpose();
}

Matrix4d FeatureHypothesis::transition(const ViewChange& change) const {
  const Matrix2d R = change.step.T_before_now.rotation().transpose();
  Matrix4d result = Matrix4d::Identity();
  result.topLeftCorner<2, 2>() = R;
  if (isMoving()) {
    result.topRightCorner<2, 2>() = change.elapsed * R;
    result.bottomRightCorner<2, 2>() = R;
  } else if (isSliding()) {
    result.col(kRatio).head<2>() = change.sideways * (R * along_);
  } else {
    result.col(kScale).head<2>() = change.step.scaleEffect();
  }
  return result;
}

void FeatureHypothesis::addNoise(const ViewChange& change) {
  covariance_.topLeftCorner<2, 2>() += change.step.noiseAt(position());
  const double scale = config_->odometry.scale_sigma;
  const Vector2d by_scale = scale * change.step.scaleEffect();
  if (isMoving() || isSliding()) {
    covariance_.topLeftCorner<2, 2>() += by_scale * by_scale.transpose();
  }
  if (isMoving()) {
    const double q = config_->acceleration * config_->acceleration * change.elapsed;
    const double t = change.elapsed;
    covariance_.topLeftCorner<2, 2>() += q * t * t / 3.0 * Matrix2d::Identity();
    covariance_.topRightCorner<2, 2>() += q * t / 2.0 * Matrix2d::Identity();
    covariance_.bottomLeftCorner<2, 2>() += q * t / 2.0 * Matrix2d::Identity();
    covariance_.bottomRightCorner<2, 2>() += q * Matrix2d::Identity();
  } else if (isSliding()) {
    const double way = std::abs(change.sideways);
    const double unsteady = kSliding.unsteadiness * way;
    covariance_.topLeftCorner<2, 2>() += unsteady * unsteady * along_ * along_.transpose();
    covariance_(kRatio, kRatio) += kSliding.ratio_walk * kSliding.ratio_walk * way;
  }
}

// Draws the offset anew as far as the beams fall elsewhere.
void FeatureHypothesis::forgetOffset(double correlation) {
  if (isMoving()) return;
  state_[kOffset] *= correlation;
  covariance_.row(kOffset) *= correlation;
  covariance_.col(kOffset) *= correlation;
  covariance_(kOffset, kOffset) += (1.0 - correlation * correlation) * between_beams_;
}

void FeatureHypothesis::predict(const ViewChange& change) {
  const Matrix4d F = transition(change);
  const Vector2d moved =
      position() + (isMoving() ? change.elapsed * velocity() : Vector2d(Vector2d::Zero()));
  Vector2d place = change.step.seenNow(moved);
  if (isSliding()) place += state_[kRatio] * F.col(kRatio).head<2>();
  if (!isMoving() && !isSliding()) place += state_[kScale] * F.col(kScale).head<2>();
  state_ = F * state_;
  state_.head<2>() = place;
  along_ = change.step.T_before_now.rotation().transpose() * along_;
  covariance_ = F * covariance_ * F.transpose();
  addNoise(change);
  forgetOffset(change.beam_correlation);
}

FeatureHypothesis::Innovation FeatureHypothesis::innovation(const Sighting& sighting) const {
  const Response H = responseOf(sighting);
  return {sighting.position - H * state_, H * covariance_ * H.transpose() + noiseOf(sighting)};
}

void FeatureHypothesis::update(const Sighting& sighting) {
  // What is left of the variance of the offset is new where the end lies farther off now.
  if (!isMoving() && sighting.between_beams > between_beams_) {
    covariance_(kOffset, kOffset) += sighting.between_beams - between_beams_;
  }
  between_beams_ = sighting.between_beams;
  along_ = sighting.along;
  const Response H = responseOf(sighting);
  const Innovation found = innovation(sighting);
  const Eigen::Matrix<double, 4, 2> gain = covariance_ * H.transpose() * found.covariance.inverse();
  state_ += gain * found.residual;
  const Matrix4d kept = Matrix4d::Identity() - gain * H;
  covariance_ = kept * covariance_ * kept.transpose() + gain * noiseOf(sighting) * gain.transpose();
}

Vector2d FeatureHypothesis::velocity() const {
  return isMoving() ? Vector2d(state_.tail<2>()) : Vector2d(Vector2d::Zero());
}

}  // namespace sightline::lines
