#include "sightline/gaze/pose_uncertainty.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

namespace sightline::gaze {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using geometry::Pose2;

constexpr double kWallSigma = 0.01;  // [m]
constexpr double kTurnSigma = 0.004;
const Vector2d kWallSigmas(kWallSigma, kTurnSigma);

WallLook lookAt(std::size_t wall, const Vector2d& middle, const Vector2d& normal) {
  WallLook look{{0, wall}, middle, normal};
  look.information << 4e6, 1e6, 1e6, 3e6;
  look.from = 0.0;
  look.to = 1.0;
  return look;
}

const WallLook kEast = lookAt(0, {2.0, 0.3}, {-1.0, 0.0});
const WallLook kWest = lookAt(1, {-2.0, -0.4}, {1.0, 0.0});
const Matrix3d kStart = Eigen::Vector3d(0.01, 0.02, 0.001).asDiagonal();

TEST(PoseUncertainty, OneWallSeenForEverLeavesItsOwnError) {
  PoseUncertainty uncertainty(kStart, kWallSigmas);
  for (int i = 0; i < 5000; ++i) uncertainty.take(kEast, {0.0, 0.3}, 1.0);
  const Matrix3d covariance = uncertainty.covariance();
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), kWallSigma, 0.1 * kWallSigma);
  EXPECT_NEAR(std::sqrt(covariance(2, 2)), kTurnSigma, 0.1 * kTurnSigma);
  EXPECT_NEAR(covariance(1, 1), kStart(1, 1), 1e-9) << "along the wall nothing is told";
}

TEST(PoseUncertainty, SecondWallTakesHalfOfIt) {
  PoseUncertainty uncertainty(kStart, {kWallSigma, 1e-6});
  for (int i = 0; i < 5000; ++i) {
    uncertainty.take(kEast, {0.0, 0.0}, 1.0);
    uncertainty.take(kWest, {0.0, 0.0}, 1.0);
  }
  EXPECT_NEAR(uncertainty.covariance()(0, 0), 0.5 * kWallSigma * kWallSigma, 1e-5);
}

// Pose and walls in one state, with the same gains.
class Joint {
 public:
  Joint() {
    covariance_.setZero();
    covariance_.topLeftCorner<3, 3>() = kStart;
    for (int wall = 0; wall < 2; ++wall) {
      covariance_.block<2, 2>(3 + 2 * wall, 3 + 2 * wall) = wallPrior();
    }
  }
  void move(const Pose2& pose, const Pose2& step, const motion::OdometryNoise& noise) {
    Eigen::Matrix<double, 7, 7> F = Eigen::Matrix<double, 7, 7>::Identity();
    F.topLeftCorner<3, 3>() = geometry::composeJacobianFirst(pose, step);
    const Matrix3d G = geometry::composeJacobianSecond(pose);
    const Matrix3d Q = G * motion::stepCovariance(noise, step) * G.transpose();
    covariance_ = F * covariance_ * F.transpose();
    covariance_.topLeftCorner<3, 3>() += Q;
    assumed_ = F.topLeftCorner<3, 3>() * assumed_ * F.topLeftCorner<3, 3>().transpose() + Q;
  }
  void take(const WallLook& look, const Vector2d& base) {
    const Vector2d arm = look.middle - base;
    Eigen::Matrix<double, 2, 7> H = Eigen::Matrix<double, 2, 7>::Zero();
    H.row(0).head<3>() << look.normal.transpose(),
        look.normal.y() * arm.x() - look.normal.x() * arm.y();
    H(1, 2) = 1.0;
    H.block<2, 2>(0, 3 + 2 * static_cast<int>(look.wall.wall)).setIdentity();
    const Eigen::Matrix<double, 2, 3> H_pose = H.leftCols<3>();
    const Eigen::Matrix2d R = look.information.inverse();
    const Eigen::Matrix2d S = H_pose * assumed_ * H_pose.transpose() + R + wallPrior();
    Eigen::Matrix<double, 7, 2> K = Eigen::Matrix<double, 7, 2>::Zero();
    K.topRows<3>() = assumed_ * H_pose.transpose() * S.inverse();
    const Eigen::Matrix<double, 7, 7> I_KH = Eigen::Matrix<double, 7, 7>::Identity() - K * H;
    covariance_ = I_KH * covariance_ * I_KH.transpose() + K * R * K.transpose();
    assumed_ -= K.topRows<3>() * S * K.topRows<3>().transpose();
  }
  Matrix3d pose() const { return covariance_.topLeftCorner<3, 3>(); }

 private:
  static Eigen::Matrix2d wallPrior() { return kWallSigmas.cwiseAbs2().asDiagonal(); }
  Eigen::Matrix<double, 7, 7> covariance_;
  Matrix3d assumed_ = kStart;
};

// What the gains take for noise of each scan and is none is counted in both: never less than the
// joint covariance, and not much more.
TEST(PoseUncertainty, HoldsTheJointCovarianceOfPoseAndWalls) {
  PoseUncertainty uncertainty(kStart, kWallSigmas);
  Joint joint;
  const motion::OdometryNoise noise = motion::OdometryNoise::unmeasured();
  Pose2 pose(0.1, -0.2, 0.3);
  for (int i = 0; i < 60; ++i) {
    const Pose2 step(0.03, 0.0, 0.01);
    uncertainty.predict(pose, step, noise);
    joint.move(pose, step, noise);
    pose = pose * step;
    const WallLook& look = i % 20 < 10 ? kEast : kWest;
    uncertainty.take(look, pose.translation(), 1.0);
    joint.take(look, pose.translation());
    const Matrix3d more = uncertainty.covariance() - joint.pose();
    EXPECT_GT(more.trace(), -1e-9);
    EXPECT_LT(uncertainty.covariance()(0, 0), 3.0 * joint.pose()(0, 0));
  }
}

TEST(PoseUncertainty, TakesOverWhatTheTrackerSays) {
  PoseUncertainty uncertainty(kStart, kWallSigmas);
  for (int i = 0; i < 50; ++i) uncertainty.take(kEast, {0.0, 0.3}, 1.0);
  const Matrix3d told = Eigen::Vector3d(4e-4, 9e-4, 1e-4).asDiagonal();
  uncertainty.adopt(told);
  EXPECT_TRUE(uncertainty.covariance().isApprox(told, 1e-9));
}

}  // namespace
}  // namespace sightline::gaze
