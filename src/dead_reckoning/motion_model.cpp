#include "sightline/dead_reckoning/motion_model.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

struct PredictionTuning {
  // Half width of a search window in standard deviations of the prediction.
  double window_sigmas = 3.0;
  // Standard deviation that the velocity tends to, as a share of the carrier's largest. Chosen by
  // hand.
  double velocity_share = 0.5;
};
constexpr PredictionTuning kPrediction{};

// One axis of the motion.
struct Axis {
  double kept;   // share of the last velocity that goes on
  double sigma;  // standard deviation of the displacement
};

// `acceleration` is how far the velocity wanders in a second, `most` its bound.
Axis predictAxis(double acceleration, double most, double elapsed) {
  const double velocity_sigma = kPrediction.velocity_share * most;
  const double ages = elapsed * acceleration / velocity_sigma;
  const double kept = std::exp(-0.5 * ages * ages);
  return {kept, velocity_sigma * elapsed * std::sqrt(1.0 - kept * kept)};
}

// A perturbation on the right of a step, as one of its coordinates.
Eigen::Matrix3d alongStart(const geometry::Pose2& step) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes.topLeftCorner<2, 2>() = step.rotation();
  return axes;
}

Eigen::Vector3d possible(const CarrierConfig& carrier, const Eigen::Vector3d& twist) {
  const double speed = twist.head<2>().norm();
  Eigen::Vector3d bounded = twist;
  if (speed > carrier.max_speed) bounded.head<2>() *= carrier.max_speed / speed;
  bounded[2] = std::clamp(twist[2], -carrier.max_turn_rate, carrier.max_turn_rate);
  return bounded;
}

}  // namespace

StepPrediction predictStep(const CarrierConfig& carrier, const Eigen::Vector3d& twist,
                           double elapsed) {
  const Axis position = predictAxis(carrier.acceleration, carrier.max_speed, elapsed);
  const Axis heading = predictAxis(carrier.turn_acceleration, carrier.max_turn_rate, elapsed);
  const Eigen::Vector3d kept =
      elapsed * Eigen::Vector3d(position.kept, position.kept, heading.kept);
  const Eigen::Vector3d sigma(position.sigma, position.sigma, heading.sigma);
  const Eigen::Vector3d tangent = kept.cwiseProduct(possible(carrier, twist));
  StepPrediction prediction;
  prediction.step = geometry::Pose2::exp(tangent);
  prediction.covariance = sigma.cwiseAbs2().asDiagonal();
  prediction.by_twist =
      alongStart(prediction.step) * geometry::expRightJacobian(tangent) * kept.asDiagonal();
  return prediction;
}

Eigen::Matrix3d twistJacobian(const geometry::Pose2& step, double elapsed) {
  return geometry::logRightJacobian(step.log()) * alongStart(step).transpose() / elapsed;
}

SearchWindow windowOf(const CarrierConfig& carrier, const geometry::UncertainPose2& T_odom_base,
                      double elapsed) {
  const Eigen::Vector3d sigma = T_odom_base.covariance.diagonal().cwiseSqrt();
  const double position = kPrediction.window_sigmas * std::max(sigma.x(), sigma.y());
  return {T_odom_base.mean, std::min(position, carrier.max_speed * elapsed),
          std::min({kPrediction.window_sigmas * sigma.z(), carrier.max_turn_rate * elapsed,
                    geometry::kPi})};
}

}  // namespace sightline::dead_reckoning
