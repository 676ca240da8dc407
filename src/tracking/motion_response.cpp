#include "sightline/tracking/motion_response.h"

#include <algorithm>

#include <Eigen/LU>

#include "sightline/tracking/gated_wall.h"

namespace sightline::tracking {

namespace {

struct PointTerm {
  double weight;
  Eigen::Vector2d residual_by_line;
  Eigen::RowVector3d residual_by_motion;
};

PointTerm termOf(const BeamPoint& point, const Eigen::Vector2d& normal,
                 const Eigen::Vector2d& along) {
  const double sigma = pointSigma(point, normal);
  const double position = along.dot(point.position);
  return {1.0 / (sigma * sigma), {-1.0, position}, {normal.x(), normal.y(), -position}};
}

}  // namespace

MotionResponse::MotionResponse(const std::vector<const BeamPoint*>& points,
                               const geometry::PolarLine& line) {
  const Eigen::Vector2d normal = line.normal();
  const Eigen::Vector2d along = line.direction();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (const BeamPoint* point : points) {
    const PointTerm term = termOf(*point, normal, along);
    information += term.weight * term.residual_by_line * term.residual_by_line.transpose();
  }
  const Eigen::Matrix2d gain = -information.inverse();
  for (const BeamPoint* point : points) {
    const PointTerm term = termOf(*point, normal, along);
    add(point->sweep_ratio, term.weight * gain * term.residual_by_line * term.residual_by_motion);
  }
}

// A point moves by its share of the way from one knot to the next.
void MotionResponse::add(double sweep_ratio, const Eigen::Matrix<double, 2, 3>& response) {
  const double place = kKnots * sweep_ratio;
  const int passed = std::clamp(static_cast<int>(place), 0, kKnots - 1);
  const double share = place - passed;
  jacobian_.middleCols<3>(3 * passed) += share * response;
  if (passed > 0) jacobian_.middleCols<3>(3 * (passed - 1)) += (1.0 - share) * response;
  between_[static_cast<std::size_t>(passed)].add(share, response);
}

Eigen::Matrix2d MotionResponse::strayCovariance(const Eigen::Matrix3d& walk) const {
  if (walk.isZero(0.0)) return Eigen::Matrix2d::Zero();
  scan::MotionNoise bridge;
  bridge.walk = walk / kKnots;
  bridge.drift = -bridge.walk;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (motion::MotionSum<2> sum : between_) covariance += sum.covariance(bridge);
  return covariance;
}

}  // namespace sightline::tracking
