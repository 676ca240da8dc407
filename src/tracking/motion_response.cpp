#include "sightline/tracking/motion_response.h"

#include <algorithm>

#include <Eigen/LU>

namespace sightline::tracking {

namespace {

Eigen::Matrix2d covarianceOf(std::array<motion::MotionSum<2>, kKnots>& sums,
                             const Eigen::Matrix3d& walk) {
  scan::MotionNoise bridge;
  bridge.walk = walk / kKnots;
  bridge.drift = -bridge.walk;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (auto& sum : sums) covariance += sum.covariance(bridge);
  return covariance;
}

}  // namespace

// The right-hand sides are summed up first; the normal equations are solved once.
MotionResponse::MotionResponse(const std::vector<const BeamPoint*>& points,
                               const geometry::PolarLine& line, const Eigen::Matrix3d& walk) {
  const Eigen::Vector2d normal = line.normal();
  const Eigen::Vector2d along = line.direction();
  const bool walks = !walk.isZero(0.0);
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Sums sums;
  for (const BeamPoint* point : points) {
    const double weight = 1.0 / normal.dot(point->covariance * normal);
    const double position = along.dot(point->position);
    const Eigen::Vector2d residual_by_line(-1.0, position);
    const Eigen::RowVector3d residual_by_motion(normal.x(), normal.y(), -position);
    information += weight * residual_by_line * residual_by_line.transpose();
    add(point->sweep_ratio, weight * residual_by_line * residual_by_motion,
        walks ? &sums : nullptr);
  }
  const Eigen::Matrix2d gain = -information.inverse();
  jacobian_ = gain * jacobian_;
  if (walks) stray_covariance_ = gain * covarianceOf(sums, walk) * gain.transpose();
}

// A point moves by its share of the way from one knot to the next.
void MotionResponse::add(double sweep_ratio, const Eigen::Matrix<double, 2, 3>& response,
                         Sums* sums) {
  const double place = kKnots * sweep_ratio;
  const int passed = std::clamp(static_cast<int>(place), 0, kKnots - 1);
  const double share = place - passed;
  jacobian_.middleCols<3>(3 * passed) += share * response;
  if (passed > 0) jacobian_.middleCols<3>(3 * (passed - 1)) += (1.0 - share) * response;
  if (sums) (*sums)[static_cast<std::size_t>(passed)].add(share, response);
}

}  // namespace sightline::tracking
