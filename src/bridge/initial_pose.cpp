#include "sightline/bridge/initial_pose.h"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline::bridge {

namespace {

Eigen::Matrix3d diagonalCovariance(const std::array<double, 2>& sigma) {
  const double position = sigma[0] * sigma[0];
  return Eigen::Vector3d(position, position, sigma[1] * sigma[1]).asDiagonal();
}

void checkOrientation(const geometry_msgs::Quaternion& q) {
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  // rviz normalises to rounding; what is further off was never a rotation.
  if (!(std::abs(norm - 1.0) < 0.01)) {
    throw BadMessage(fmt::format("an orientation of norm {}", norm));
  }
}

void checkCovariance(const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) throw BadMessage("a covariance that is not finite");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  if (!covariance.isApprox(covariance.transpose(), 1e-6) || solver.eigenvalues()[0] < 0.0) {
    throw BadMessage("a covariance that is not symmetric and positive");
  }
}

}  // namespace

geometry::UncertainPose2 readInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message,
                                         const std::string& map_frame,
                                         const std::array<double, 2>& sigma) {
  if (withoutSlash(message.header.frame_id) != map_frame) {
    throw BadMessage(
        fmt::format("in frame '{}' instead of '{}'", message.header.frame_id, map_frame));
  }
  const geometry_msgs::Point& position = message.pose.pose.position;
  if (!std::isfinite(position.x) || !std::isfinite(position.y)) {
    throw BadMessage("a position that is not finite");
  }
  checkOrientation(message.pose.pose.orientation);
  const std::string fault =
      faultOfPose({position.x, position.y, 0.0}, message.pose.pose.orientation);
  if (!fault.empty()) throw BadMessage(fault);
  const Eigen::Matrix3d covariance = toCovariance3(message.pose.covariance);
  if (covariance.isZero(0.0)) return {toPose2(message.pose.pose), diagonalCovariance(sigma)};
  checkCovariance(covariance);
  return {toPose2(message.pose.pose), covariance};
}

}  // namespace sightline::bridge
