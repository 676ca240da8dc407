#include "sightline/dead_reckoning/motion_model.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

constexpr double kSigmas = 3.0;

// One axis of the motion.
struct Axis {
  double kept;   // of the last velocity
  double sigma;  // of the way
};

// `acceleration` is how far the velocity wanders in a second, `most` its bound.
Axis predictAxis(double acceleration, double most, double elapsed) {
  const double spread = 0.5 * most;
  const double ages = elapsed * acceleration / spread;
  const double kept = std::exp(-0.5 * ages * ages);
  return {kept, spread * elapsed * std::sqrt(1.0 - kept * kept)};
}

Eigen::Vector3d possible(const CarrierConfig& carrier, const Eigen::Vector3d& twist) {
  const double speed = twist.head<2>().norm();
  Eigen::Vector3d bounded = twist;
  if (speed > carrier.max_speed) bounded.head<2>() *= carrier.max_speed / speed;
  bounded[2] = std::clamp(twist[2], -carrier.max_turn_rate, carrier.max_turn_rate);
  return bounded;
}

}  // namespace

Twist twistOf(const geometry::UncertainPose2& step, double elapsed) {
  if (elapsed <= 0.0) return {};
  const Eigen::Vector3d tangent = step.mean.log();
  // d log / d coordinates: the group's own, with its translation along the axes of the start.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = step.mean.rotation().transpose();
  const Eigen::Matrix3d jacobian = geometry::logRightJacobian(tangent) * turn / elapsed;
  return {tangent / elapsed, jacobian * step.covariance * jacobian.transpose()};
}

geometry::UncertainPose2 predictStep(const CarrierConfig& carrier, const Twist& twist,
                                     double elapsed) {
  const Axis way = predictAxis(carrier.acceleration, carrier.max_speed, elapsed);
  const Axis turn = predictAxis(carrier.turn_acceleration, carrier.max_turn_rate, elapsed);
  const Eigen::Vector3d kept = elapsed * Eigen::Vector3d(way.kept, way.kept, turn.kept);
  const Eigen::Vector3d sigma(way.sigma, way.sigma, turn.sigma);
  const Eigen::Matrix3d wander = sigma.cwiseAbs2().asDiagonal();
  return {geometry::Pose2::exp(kept.cwiseProduct(possible(carrier, twist.mean))),
          wander + kept.asDiagonal() * twist.covariance * kept.asDiagonal()};
}

SearchWindow windowOf(const CarrierConfig& carrier, const geometry::UncertainPose2& T_odom_base,
                      double elapsed) {
  const Eigen::Vector3d sigma = T_odom_base.covariance.diagonal().cwiseSqrt();
  const double position = kSigmas * std::max(sigma.x(), sigma.y());
  return {T_odom_base.mean, std::min(position, carrier.max_speed * elapsed),
          std::min({kSigmas * sigma.z(), carrier.max_turn_rate * elapsed, geometry::kPi})};
}

}  // namespace sightline::dead_reckoning
