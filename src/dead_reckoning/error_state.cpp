#include "sightline/dead_reckoning/error_state.h"

#include <cmath>

#include <Eigen/LU>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;
using Rows = Eigen::Matrix<double, 3, 9>;

// Derivatives of the next pose's coordinates.
struct Derivatives {
  Eigen::Matrix3d by_pose;
  Eigen::Matrix3d by_step;
  Eigen::Matrix3d by_twist;

  Derivatives(const Pose2& T_odom_base, const StepPrediction& prediction)
      : by_pose(geometry::composeJacobianFirst(T_odom_base, prediction.step)),
        by_step(geometry::composeJacobianSecond(T_odom_base)),
        by_twist(by_step * prediction.by_twist) {}

  // Derivatives of the pose against the reference, by the errors before.
  Rows rows() const {
    Rows rows = Rows::Zero();
    rows.block<3, 3>(0, 3) = by_pose;
    rows.block<3, 3>(0, 6) = by_twist;
    return rows;
  }
};

Eigen::Matrix3d symmetric(const Eigen::Matrix3d& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

}  // namespace

void ErrorState::reset() {
  covariance_.setZero();
  motion_.setZero();
  with_motion_.setZero();
}

Eigen::Matrix3d ErrorState::predicted(const Pose2& T_odom_base, const StepPrediction& step) const {
  const Derivatives next(T_odom_base, step);
  const Rows rows = next.rows();
  return symmetric(rows * covariance_ * rows.transpose() +
                   next.by_step * step.covariance * next.by_step.transpose());
}

// The part of the error that the reference has in common from scan to scan moves both ends of a
// step. The motion within a sweep is not of that kind: its part of the error against the reference
// stays whole.
ErrorState::Joint ErrorState::apartFrom(double common) const {
  const auto addMotion = [this](double sign, Joint& joint) {
    joint.block<3, 9>(3, 0) += sign * with_motion_.transpose();
    joint.block<9, 3>(0, 3) += sign * with_motion_;
    joint.block<3, 3>(3, 3) -= sign * with_motion_.block<3, 3>(3, 0);
  };
  Joint apart = covariance_;
  addMotion(-1.0, apart);
  apart.block<3, 9>(3, 0) *= std::sqrt(1.0 - common);
  apart.block<9, 3>(0, 3) *= std::sqrt(1.0 - common);
  addMotion(1.0, apart);
  return apart;
}

Eigen::Matrix3d ErrorState::advance(const Pose2& T_odom_base, const StepPrediction& prediction,
                                    const Pose2& step, double elapsed,
                                    const PoseMeasurement& measurement) {
  const Derivatives next(T_odom_base, prediction);
  const Eigen::Matrix3d before = predicted(T_odom_base, prediction).inverse();
  const Eigen::Matrix3d after = (before + measurement.information).inverse();
  const Eigen::Matrix3d gain = after * measurement.information;
  const Eigen::Matrix3d rest = after * before;
  const Eigen::Matrix3d of_match = after * measurement.information * after.transpose();
  const Eigen::Matrix3d noise =
      rest * next.by_step * prediction.covariance * next.by_step.transpose() * rest.transpose() +
      of_match + measurement.extra_covariance + measurement.motion_covariance;
  // Error of the end of the step besides that of its start, from the errors before.
  Rows moved = Rows::Zero();
  moved.block<3, 3>(0, 3) = -gain * next.by_pose;
  moved.block<3, 3>(0, 6) = rest * next.by_twist;
  const Eigen::Matrix3d to_twist = twistJacobian(step, elapsed) * next.by_step.transpose();
  Joint transition;
  transition << moved, moved, to_twist * moved;
  transition.block<3, 3>(0, 0) += next.by_pose;
  transition.block<3, 3>(3, 3) += next.by_pose;
  Columns entry;
  entry << Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity(), to_twist;
  const Joint apart = apartFrom(measurement.common);
  const Eigen::Matrix3d step_covariance =
      moved * apart * moved.transpose() + noise - measurement.common * of_match;
  covariance_ =
      transition * covariance_ * transition.transpose() + entry * noise * entry.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  motion_ = measurement.motion_covariance;
  with_motion_ = entry * motion_;
  return symmetric(next.by_step.transpose() * step_covariance * next.by_step);
}

void ErrorState::displace(const Eigen::Matrix3d& motion_covariance) {
  motion_ = motion_covariance;
  with_motion_.setZero();
}

// Takes the part that is handed over for independent of the part that is left: the latter is 1 -
// share of the error, and a part drawn anew.
void ErrorState::handOver(double share) {
  const Eigen::Matrix3d left = (1.0 - share) * againstReference() + share * motion_;
  covariance_.block<3, 9>(3, 0) *= 1.0 - share;
  covariance_.block<9, 3>(0, 3) *= 1.0 - share;
  covariance_.block<3, 9>(3, 0) += share * with_motion_.transpose();
  covariance_.block<9, 3>(0, 3) += share * with_motion_;
  covariance_.block<3, 3>(3, 3) = left;
  with_motion_.block<3, 3>(3, 0) *= 1.0 - share;
  with_motion_.block<3, 3>(3, 0) += share * motion_;
}

}  // namespace sightline::dead_reckoning
