#include "sightline/dead_reckoning/motion_gradient.h"

#include <algorithm>

#include <Eigen/LU>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

// Derivative of a point's distance across a surface by the coordinates (x, y, θ) of a frame that
// the point is fixed to, seen along `arm` from that frame's origin.
Eigen::Vector3d acrossSurface(const Eigen::Vector2d& normal, const Eigen::Vector2d& arm) {
  return {normal.x(), normal.y(), normal.y() * arm.x() - normal.x() * arm.y()};
}

// A covariance of (x, y, θ) along other axes.
Eigen::Matrix3d turned(const Eigen::Matrix2d& rotation, const Eigen::Matrix3d& covariance) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes.topLeftCorner<2, 2>() = rotation;
  return axes * covariance * axes.transpose();
}

}  // namespace

MotionGradient::MotionGradient(const SurfaceScan& surfaces, const Pose2& T_odom_base)
    : surfaces_(surfaces), R_odom_base_(T_odom_base.rotation()) {}

void MotionGradient::add(std::size_t point, const Eigen::Vector2d& normal_odom,
                         const Eigen::Vector3d& weighted_jacobian) {
  if (surfaces_.sightings.empty()) return;
  const Sighting& sighting = surfaces_.sightings[point];
  const Eigen::Vector2d arm =
      R_odom_base_ * (surfaces_.points[point].position - sighting.sensor_base);
  terms_.push_back(
      {sighting.time, weighted_jacobian * acrossSurface(normal_odom, arm).transpose()});
}

Eigen::Matrix3d MotionGradient::drift() const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Term& term : terms_) sum += term.time * term.by_error;
  return sum * turned(R_odom_base_, surfaces_.motion_noise.drift) * sum.transpose();
}

// The walk in a stretch of time moves all points that are seen later.
Eigen::Matrix3d MotionGradient::walk() const {
  std::vector<Term> latest_first = terms_;
  std::stable_sort(latest_first.begin(), latest_first.end(),
                   [](const Term& a, const Term& b) { return a.time > b.time; });
  const Eigen::Matrix3d rate = turned(R_odom_base_, surfaces_.motion_noise.walk);
  Eigen::Matrix3d later = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < latest_first.size(); ++i) {
    later += latest_first[i].by_error;
    const double before = i + 1 < latest_first.size() ? latest_first[i + 1].time : 0.0;
    sum += (latest_first[i].time - before) * later * rate * later.transpose();
  }
  return sum;
}

Eigen::Matrix3d MotionGradient::covariance() const {
  if (terms_.empty()) return Eigen::Matrix3d::Zero();
  return drift() + walk();
}

Eigen::Matrix3d surfaceInformation(const SurfaceScan& surfaces, const Pose2& T_odom_base,
                                   double sigma) {
  const Eigen::Matrix2d rotation = T_odom_base.rotation();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const SurfacePoint& point : surfaces.points) {
    if (!point.hasNormal()) continue;
    const Eigen::Vector3d jacobian =
        acrossSurface(rotation * point.normal, rotation * point.position);
    information += jacobian * jacobian.transpose() / (sigma * sigma);
  }
  return information;
}

Eigen::Matrix3d surfaceMotionGradient(const SurfaceScan& surfaces, const Pose2& T_odom_base,
                                      double sigma) {
  if (surfaces.sightings.empty()) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix2d rotation = T_odom_base.rotation();
  MotionGradient gradient(surfaces, T_odom_base);
  for (std::size_t i = 0; i < surfaces.points.size(); ++i) {
    const SurfacePoint& point = surfaces.points[i];
    if (!point.hasNormal()) continue;
    const Eigen::Vector2d normal = rotation * point.normal;
    gradient.add(i, normal, acrossSurface(normal, rotation * point.position) / (sigma * sigma));
  }
  return gradient.covariance();
}

Eigen::Matrix3d motionDisplacement(const SurfaceScan& surfaces, const Pose2& T_odom_base) {
  if (surfaces.sightings.empty()) return Eigen::Matrix3d::Zero();
  // One point's worth of information keeps what no surface shows finite.
  const Eigen::Matrix3d covariance =
      (surfaceInformation(surfaces, T_odom_base, 1.0) + Eigen::Matrix3d::Identity()).inverse();
  return covariance * surfaceMotionGradient(surfaces, T_odom_base, 1.0) * covariance;
}

}  // namespace sightline::dead_reckoning
