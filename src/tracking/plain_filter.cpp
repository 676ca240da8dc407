#include "sightline/tracking/plain_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

namespace sightline::tracking {

using geometry::Pose2;

void PlainFilter::predict(const PlainConfig& config, const Pose2& step) {
  const double length = step.translation().norm();
  const double along = config.distance_sigma * length;
  const double heading = std::hypot(config.heading_sigma_per_metre * std::sqrt(length),
                                    config.steering_sigma * std::abs(step.theta()));
  const Eigen::Vector2d displacement = state_.mean.rotation() * step.translation();
  const Eigen::Vector2d direction =
      length > 0.0 ? Eigen::Vector2d(displacement / length) : displacement;
  state_.covariance.topLeftCorner<2, 2>() += along * along * direction * direction.transpose();
  state_.covariance(2, 2) += heading * heading;
  state_.mean = state_.mean * step;
}

Eigen::Matrix2d PlainFilter::covarianceOf(const LineInnovation& innovation) const {
  const Eigen::Matrix<double, 2, 3>& C = innovation.pose_jacobian;
  return C * state_.covariance * C.transpose() + innovation.noise;
}

double PlainFilter::nis(const LineInnovation& innovation) const {
  return innovation.value.dot(covarianceOf(innovation).inverse() * innovation.value);
}

void PlainFilter::update(const LineInnovation& innovation) {
  const Eigen::Matrix<double, 2, 3>& C = innovation.pose_jacobian;
  Eigen::Matrix3d& P = state_.covariance;
  const Eigen::Matrix2d S = covarianceOf(innovation);
  const Eigen::Matrix<double, 3, 2> gain = P * C.transpose() * S.inverse();
  state_.mean = Pose2(state_.mean.coordinates() + gain * innovation.value);
  P -= gain * S * gain.transpose();
  P = 0.5 * (P + P.transpose()).eval();
}

void PlainFilter::inflate(double position_sigma, double heading_sigma) {
  for (const auto& [i, added] :
       {std::pair(0, position_sigma), {1, position_sigma}, {2, heading_sigma}}) {
    const double sigma = std::sqrt(state_.covariance(i, i)) + added;
    state_.covariance(i, i) = sigma * sigma;
  }
}

void PlainFilter::applyFloor(const PlainConfig& config) {
  const double position = config.floor_position_sigma * config.floor_position_sigma;
  const double heading = config.floor_heading_sigma * config.floor_heading_sigma;
  Eigen::Matrix3d& P = state_.covariance;
  P(0, 0) = std::max(P(0, 0), position);
  P(1, 1) = std::max(P(1, 1), position);
  P(2, 2) = std::max(P(2, 2), heading);
}

}  // namespace sightline::tracking
