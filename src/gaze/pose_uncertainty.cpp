#include "sightline/gaze/pose_uncertainty.h"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace sightline::gaze {

namespace {

// Walls whose share is kept: more than are seen from anywhere. Those used first are given up first.
constexpr std::size_t kMostShares = 16;
// Least variance of a direction that the walls' shares explain wholly [m², rad²].
constexpr double kLeastVariance = 1e-8;

}  // namespace

PoseUncertainty::PoseUncertainty(const Eigen::Matrix3d& covariance,
                                 const Eigen::Vector2d& wall_sigmas)
    : random_(covariance), wall_(wall_sigmas.cwiseAbs2().asDiagonal()) {}

void PoseUncertainty::predict(const geometry::Pose2& T_map_base, const geometry::Pose2& step,
                              const motion::OdometryNoise& noise) {
  const Eigen::Matrix3d F = geometry::composeJacobianFirst(T_map_base, step);
  const Eigen::Matrix3d G = geometry::composeJacobianSecond(T_map_base);
  random_ = F * random_ * F.transpose() + G * motion::stepCovariance(noise, step) * G.transpose();
  for (Share& share : shares_) share.of_pose = (F * share.of_pose).eval();
}

PoseUncertainty::ByWall& PoseUncertainty::shareOf(const world::WallIndex& wall) {
  const auto known = std::find_if(shares_.begin(), shares_.end(), [&](const Share& share) {
    return share.wall.room == wall.room && share.wall.wall == wall.wall;
  });
  if (known != shares_.end()) return known->of_pose;
  if (shares_.size() >= kMostShares) {
    const ByWall& first = shares_.front().of_pose;
    random_ += first * wall_ * first.transpose();
    shares_.erase(shares_.begin());
  }
  shares_.push_back({wall, ByWall::Zero()});
  return shares_.back().of_pose;
}

// The gain takes the wall's error for noise of each scan, as the tracker's does.
void PoseUncertainty::take(const WallLook& look, const Eigen::Vector2d& base, double scans) {
  Eigen::Matrix2d noise;
  bool is_line = false;
  const Eigen::Matrix2d information = scans * look.information;
  information.computeInverseWithCheck(noise, is_line);
  if (!is_line) return;
  const Eigen::Vector2d arm = look.middle - base;
  Eigen::Matrix<double, 2, 3> response;
  response << look.normal.x(), look.normal.y(),
      look.normal.y() * arm.x() - look.normal.x() * arm.y(), 0.0, 0.0, 1.0;
  const Eigen::Matrix2d S = response * random_ * response.transpose() + noise + wall_ / scans;
  const ByWall gain = random_ * response.transpose() * S.inverse();
  random_ -= gain * S * gain.transpose();
  random_ = 0.5 * (random_ + random_.transpose()).eval();
  const ByWall* own = &shareOf(look.wall);
  for (Share& share : shares_) {
    Eigen::Matrix2d by_wall = response * share.of_pose;
    if (&share.of_pose == own) by_wall += Eigen::Matrix2d::Identity();
    share.of_pose -= gain * by_wall;
  }
}

Eigen::Matrix3d PoseUncertainty::ofWalls() const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Share& share : shares_) sum += share.of_pose * wall_ * share.of_pose.transpose();
  return sum;
}

void PoseUncertainty::adopt(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> rest(covariance - ofWalls());
  const Eigen::Vector3d variances = rest.eigenvalues().cwiseMax(kLeastVariance);
  random_ = rest.eigenvectors() * variances.asDiagonal() * rest.eigenvectors().transpose();
}

Eigen::Matrix3d PoseUncertainty::covariance() const {
  return random_ + ofWalls();
}

}  // namespace sightline::gaze
