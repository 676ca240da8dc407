#include "sightline/tracking/motion_response.h"

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
  jacobian_.setZero();
  for (const BeamPoint* point : points) {
    const PointTerm term = termOf(*point, normal, along);
    const Eigen::Matrix<double, 2, 3> response =
        term.weight * gain * term.residual_by_line * term.residual_by_motion;
    jacobian_ += point->sweep_ratio * response;
    sum_.add(point->sweep_ratio, response);
  }
}

Eigen::Matrix2d MotionResponse::strayCovariance(const Eigen::Matrix3d& walk) const {
  if (walk.isZero(0.0)) return Eigen::Matrix2d::Zero();
  scan::MotionNoise bridge;
  bridge.walk = walk;
  bridge.drift = -walk;
  return motion::MotionSum<2>(sum_).covariance(bridge);
}

}  // namespace sightline::tracking
