#include "sightline/dead_reckoning/error_state.h"

#include <cmath>

#include <Eigen/LU>

#include "sightline/dead_reckoning/unbound_axis.h"

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;
using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic>;

// Derivatives of the next pose's coordinates.
struct Derivatives {
  Eigen::Matrix3d by_pose;
  Eigen::Matrix3d by_step;
  Eigen::Matrix3d by_twist;

  Derivatives(const Pose2& T_odom_base, const StepPrediction& prediction)
      : by_pose(geometry::composeJacobianFirst(T_odom_base, prediction.step)),
        by_step(geometry::composeJacobianSecond(T_odom_base)),
        by_twist(by_step * prediction.by_twist) {}
};

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

// ∂(twist)/∂(pose at the end of its interval, along the axes of odom).
Eigen::Matrix3d twistByPose(const TwistInterval& interval) {
  return twistJacobian(interval.step, interval.elapsed) *
         geometry::composeJacobianSecond(interval.T_odom_base).transpose();
}

}  // namespace

void ErrorState::reset() {
  covariance_.setZero(kScanners, kScanners);
  motion_.setZero();
  with_motion_.setZero(kScanners, 3);
}

void ErrorState::makeRoomFor(std::size_t scanner) {
  const Eigen::Index size = kScanners + 3 * (static_cast<Eigen::Index>(scanner) + 1);
  const Eigen::Index before = covariance_.rows();
  if (size <= before) return;
  covariance_.conservativeResizeLike(Joint::Zero(size, size));
  with_motion_.conservativeResizeLike(Columns::Zero(size, 3));
}

void ErrorState::forgetScans() {
  covariance_.conservativeResize(kScanners, kScanners);
  with_motion_.conservativeResize(kScanners, 3);
}

Eigen::Matrix3d ErrorState::predicted(const Pose2& T_odom_base, const StepPrediction& step) const {
  const Derivatives next(T_odom_base, step);
  Eigen::Matrix<double, 3, 6> rows;
  rows << next.by_pose, next.by_twist;
  return symmetric(rows * covariance_.block<6, 6>(kAgainst, kAgainst) * rows.transpose() +
                   next.by_step * step.covariance * next.by_step.transpose());
}

// The part of the error that the reference has in common from scan to scan moves both ends of a
// step. The motion within a sweep is not of that kind: its part of the error against the reference
// stays whole.
ErrorState::Joint ErrorState::apartFrom(double common) const {
  const auto addMotion = [this](double sign, Joint& joint) {
    joint.middleRows<3>(kAgainst) += sign * with_motion_.transpose();
    joint.middleCols<3>(kAgainst) += sign * with_motion_;
    joint.block<3, 3>(kAgainst, kAgainst) -= sign * with_motion_.middleRows<3>(kAgainst);
  };
  Joint apart = covariance_;
  addMotion(-1.0, apart);
  apart.middleRows<3>(kAgainst) *= std::sqrt(1.0 - common);
  apart.middleCols<3>(kAgainst) *= std::sqrt(1.0 - common);
  addMotion(1.0, apart);
  return apart;
}

Eigen::Matrix3d ErrorState::advance(const Pose2& T_odom_base, const StepPrediction& prediction,
                                    const TwistInterval& interval,
                                    const PoseMeasurement& measurement) {
  makeRoomFor(interval.scanner);
  const Derivatives next(T_odom_base, prediction);
  const Eigen::Matrix3d before =
      turnedToUnbound(predicted(T_odom_base, prediction), measurement.information).inverse();
  const Eigen::Matrix3d after = (before + measurement.information).inverse();
  const Eigen::Matrix3d gain = after * measurement.information;
  const Eigen::Matrix3d rest = after * before;
  const Eigen::Matrix3d of_match = after * measurement.information * after.transpose();
  const Eigen::Matrix3d noise =
      rest * next.by_step * prediction.covariance * next.by_step.transpose() * rest.transpose() +
      of_match + measurement.extra_covariance + measurement.motion_covariance;
  // Error of the end of the step besides that of its start, from the errors before.
  Rows moved = Rows::Zero(3, covariance_.rows());
  moved.middleCols<3>(kAgainst) = -gain * next.by_pose;
  moved.middleCols<3>(kTwist) = rest * next.by_twist;
  const Eigen::Matrix3d step_covariance =
      moved * apartFrom(measurement.common) * moved.transpose() + noise -
      measurement.common * of_match;
  propagate(moved, next.by_pose, interval, noise, measurement.motion_covariance);
  return symmetric(next.by_step.transpose() * step_covariance * next.by_step);
}

// Every pose goes on by the step; the twist is that over the scanner's interval, which ends here.
void ErrorState::propagate(const Rows& moved, const Eigen::Matrix3d& by_pose,
                           const TwistInterval& interval, const Eigen::Matrix3d& noise,
                           const Eigen::Matrix3d& motion) {
  const Eigen::Index size = covariance_.rows();
  const Eigen::Index own = kScanners + 3 * static_cast<Eigen::Index>(interval.scanner);
  Joint transition = Joint::Zero(size, size);
  Columns entry = Columns::Zero(size, 3);
  for (Eigen::Index place = 0; place < size; place += 3) {
    if (place == kTwist) continue;
    transition.middleRows<3>(place) = moved;
    transition.block<3, 3>(place, place) += by_pose;
    entry.middleRows<3>(place).setIdentity();
  }
  if (interval.elapsed > 0.0) {
    const Eigen::Matrix3d to_twist = twistByPose(interval);
    transition.middleRows<3>(kTwist) = to_twist * transition.middleRows<3>(own);
    entry.middleRows<3>(kTwist) = to_twist;
  } else {
    transition.block<3, 3>(kTwist, kTwist).setIdentity();
  }
  transition.middleRows<3>(own).setZero();
  entry.middleRows<3>(own).setZero();
  covariance_ = symmetric(transition * covariance_ * transition.transpose() +
                          entry * noise * entry.transpose());
  motion_ = motion;
  with_motion_ = entry * motion_;
}

void ErrorState::displace(const Eigen::Matrix3d& motion_covariance) {
  motion_ = motion_covariance;
  with_motion_.setZero();
}

// Takes the part that is handed over for independent of the part that is left: the latter is 1 -
// share of the error, and a part drawn anew.
void ErrorState::handOver(double share) {
  const Eigen::Matrix3d left = (1.0 - share) * againstReference() + share * motion_;
  covariance_.middleRows<3>(kAgainst) *= 1.0 - share;
  covariance_.middleCols<3>(kAgainst) *= 1.0 - share;
  covariance_.middleRows<3>(kAgainst) += share * with_motion_.transpose();
  covariance_.middleCols<3>(kAgainst) += share * with_motion_;
  covariance_.block<3, 3>(kAgainst, kAgainst) = left;
  with_motion_.middleRows<3>(kAgainst) *= 1.0 - share;
  with_motion_.middleRows<3>(kAgainst) += share * motion_;
}

}  // namespace sightline::dead_reckoning
