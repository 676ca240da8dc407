#include "sightline/motion/odometry_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace sightline::motion {

using geometry::Pose2;

namespace {

constexpr struct {
  int rounds = 4;             // of errors and spreads in turn: both have settled after three
  double step = 1e-5;         // of a numeric derivative
  double least_length = 5.0;  // [m]
  double least_turn = 4.0 * geometry::kPi;  // [rad]
  double most_sigma = 0.01;
  // Least spreads, so that no drive on a perfect floor makes later wheels infallible [m, rad].
  double least_position = 0.002;
  double least_heading = 0.002;
  double leg_length = 0.5;  // [m]
  double leg_turn = 0.5;    // [rad]
  // Uncertainty of the systematic errors before the fit.
  double prior = 0.1;
} kFit;

double lengthOf(const OdometryLeg& leg) {
  double length = 0.0;
  for (const Pose2& step : leg.reported) length += step.translation().norm();
  return length;
}

double turnOf(const OdometryLeg& leg) {
  double turn = 0.0;
  for (const Pose2& step : leg.reported) turn += std::abs(step.theta());
  return turn;
}

OdometryNoise with(OdometryNoise noise, const Eigen::Vector3d& errors) {
  noise.scale_mean = errors[0];
  noise.steering_bias = errors[1];
  noise.heading_bias_per_metre = errors[2];
  return noise;
}

Pose2 expected(const OdometryLeg& leg, const OdometryNoise& noise) {
  Pose2 moved;
  for (const Pose2& step : leg.reported) {
    moved = moved * expectedStep(noise, step, noise.scale_mean);
  }
  return moved;
}

Eigen::Vector3d residualOf(const OdometryLeg& leg, const OdometryNoise& noise) {
  return geometry::between(expected(leg, noise), leg.moved.mean).log();
}

Eigen::Matrix3d covarianceOf(const OdometryLeg& leg, const OdometryNoise& noise) {
  Eigen::Matrix3d covariance = leg.moved.covariance;
  Pose2 moved;
  for (const Pose2& step : leg.reported) {
    const Pose2 next = expectedStep(noise, step, noise.scale_mean);
    const Eigen::Matrix3d G = geometry::composeJacobianSecond(moved);
    covariance += G * stepCovariance(noise, next) * G.transpose();
    moved = moved * next;
  }
  return covariance;
}

struct Solution {
  Eigen::Vector3d errors;
  Eigen::Matrix3d covariance;
};

// One step of Gauss-Newton, from errors that are near: the model is all but linear in them.
Solution solve(const std::vector<OdometryLeg>& legs, const OdometryNoise& noise) {
  const Eigen::Vector3d start(noise.scale_mean, noise.steering_bias, noise.heading_bias_per_metre);
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity() / (kFit.prior * kFit.prior);
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const OdometryLeg& leg : legs) {
    const Eigen::Vector3d residual = residualOf(leg, noise);
    Eigen::Matrix3d jacobian;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d moved = start + kFit.step * Eigen::Vector3d::Unit(i);
      jacobian.col(i) = (residual - residualOf(leg, with(noise, moved))) / kFit.step;
    }
    const Eigen::Matrix3d weight = covarianceOf(leg, noise).inverse();
    information += jacobian.transpose() * weight * jacobian;
    gradient += jacobian.transpose() * weight * residual;
  }
  return {start + information.ldlt().solve(gradient), information.inverse()};
}

// Sums of squared residuals, less what the true poses are unsure of, against what they grow with.
struct Spreads {
  double along = 0.0;
  double across = 0.0;
  double length = 0.0;
  Eigen::Matrix2d heading_by = Eigen::Matrix2d::Zero();  // of length and turn
  Eigen::Vector2d heading = Eigen::Vector2d::Zero();

  void add(const OdometryLeg& leg, const OdometryNoise& noise) {
    const Eigen::Vector3d residual = residualOf(leg, noise);
    const Eigen::Vector3d known = leg.moved.covariance.diagonal();
    along += residual[0] * residual[0] - known[0];
    across += residual[1] * residual[1] - known[1];
    length += lengthOf(leg);
    const Eigen::Vector2d cause(lengthOf(leg), turnOf(leg));
    heading_by += cause * cause.transpose();
    heading += cause * (residual[2] * residual[2] - known[2]);
  }
};

double sigmaOf(double variance, double least) {
  return std::max(least, std::sqrt(std::max(variance, 0.0)));
}

void setSpreads(const std::vector<OdometryLeg>& legs, OdometryNoise& noise) {
  Spreads spreads;
  for (const OdometryLeg& leg : legs) spreads.add(leg, noise);
  if (spreads.length > 0.0) {
    noise.distance_sigma = sigmaOf(spreads.along / spreads.length, kFit.least_position);
    noise.lateral_sigma = sigmaOf(spreads.across / spreads.length, kFit.least_position);
  }
  const Eigen::Matrix2d damping = 1e-9 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d variances = (spreads.heading_by + damping).ldlt().solve(spreads.heading);
  noise.heading_sigma_per_metre = sigmaOf(variances[0], kFit.least_heading);
  noise.steering_sigma = sigmaOf(variances[1], kFit.least_heading);
}

FittedError judged(double value, double sigma, bool is_enough, double otherwise) {
  const bool is_known = is_enough && sigma < kFit.most_sigma;
  return {is_known ? value : otherwise, sigma, is_known};
}

}  // namespace

OdometryFit fitOdometry(const std::vector<OdometryLeg>& legs) {
  const OdometryNoise unmeasured = OdometryNoise::unmeasured();
  OdometryFit fit;
  fit.noise = unmeasured;
  for (const OdometryLeg& leg : legs) {
    fit.length += lengthOf(leg);
    fit.turn += turnOf(leg);
  }
  fit.legs = legs.size();
  Solution solution{{unmeasured.scale_mean, unmeasured.steering_bias, 0.0}, {}};
  solution.covariance = Eigen::Matrix3d::Identity();
  for (int round = 0; round < kFit.rounds && !legs.empty(); ++round) {
    solution = solve(legs, fit.noise);
    fit.noise = with(fit.noise, solution.errors);
    setSpreads(legs, fit.noise);
  }
  const Eigen::Vector3d sigmas = solution.covariance.diagonal().cwiseSqrt();
  const bool is_long = fit.length >= kFit.least_length;
  const bool turns = fit.turn >= kFit.least_turn;
  fit.scale = judged(solution.errors[0], sigmas[0], is_long, unmeasured.scale_mean);
  fit.steering = judged(solution.errors[1], sigmas[1], turns, unmeasured.steering_bias);
  fit.heading = judged(solution.errors[2], sigmas[2], is_long, unmeasured.heading_bias_per_metre);
  fit.noise = with(fit.noise, {fit.scale.value, fit.steering.value, fit.heading.value});
  fit.noise.scale_sigma =
      fit.scale.is_known ? std::max(sigmas[0], kFit.least_position) : unmeasured.scale_sigma;
  return fit;
}

void OdometryLegs::begin(const Pose2& T_odom_base, const geometry::UncertainPose2& T_map_base) {
  reported_.clear();
  T_odom_base_ = T_odom_base;
  start_ = T_map_base;
  length_ = turn_ = 0.0;
  is_going_ = true;
}

void OdometryLegs::add(const Pose2& T_odom_base, const geometry::UncertainPose2& T_map_base) {
  if (!is_going_) return begin(T_odom_base, T_map_base);
  reported_.push_back(geometry::between(T_odom_base_, T_odom_base));
  T_odom_base_ = T_odom_base;
  length_ += reported_.back().translation().norm();
  turn_ += std::abs(reported_.back().theta());
  if (length_ < kFit.leg_length && turn_ < kFit.leg_turn) return;
  const Eigen::Matrix3d by_start = geometry::inverseJacobian(start_.mean);
  const Pose2 T_start_map = start_.mean.inverse();
  const Eigen::Matrix3d of_start =
      geometry::composeJacobianFirst(T_start_map, T_map_base.mean) * by_start;
  const Eigen::Matrix3d of_end = geometry::composeJacobianSecond(T_start_map);
  const Eigen::Matrix3d covariance = of_start * start_.covariance * of_start.transpose() +
                                     of_end * T_map_base.covariance * of_end.transpose();
  legs_.push_back({reported_, {T_start_map * T_map_base.mean, covariance}});
  begin(T_odom_base, T_map_base);
}

}  // namespace sightline::motion
