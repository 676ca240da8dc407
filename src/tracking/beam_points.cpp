#include "sightline/tracking/beam_points.h"

#include <Eigen/LU>

#include "sightline/motion/sweep_noise.h"

namespace sightline::tracking {

namespace {

using geometry::Pose2;

// Covariance that the jitter about an axis gives a point.
Eigen::Matrix2d jitterAt(const Eigen::Vector2d& point, const scan::MotionNoise& noise) {
  const Eigen::Vector2d arm = point - noise.jitter_axis;
  const Eigen::Vector2d across(-arm.y(), arm.x());
  return noise.jitter * across * across.transpose();
}

// From coordinates of the sensor at the last beam to a twist of the base.
Eigen::Matrix3d toBaseTwist(const scan::Scan& scan, const Pose2& T_base_sensor) {
  const Pose2 motion = scan.sensorMotion().empty() ? Pose2() : scan.sensorMotion().back();
  return T_base_sensor.adjoint() * motion::coordinatesByStartTwist(motion).inverse();
}

void readMotionNoise(const scan::Scan& scan, const Pose2& T_base_sensor, Sweep& sweep) {
  const scan::MotionNoise& noise = scan.motion_noise;
  if (noise.isZero()) return;
  const Eigen::Matrix3d to_base = toBaseTwist(scan, T_base_sensor);
  sweep.motion_noise.drift = to_base * noise.drift * to_base.transpose();
  sweep.motion_noise.walk = to_base * noise.walk * to_base.transpose();
}

}  // namespace

BeamEnds::BeamEnds(const std::vector<BeamPoint>& points) {
  x.reserve(points.size());
  y.reserve(points.size());
  for (const BeamPoint& point : points) {
    x.push_back(point.position.x());
    y.push_back(point.position.y());
  }
}

Sweep readSweep(const scan::Scan& scan, const Pose2& T_base_sensor) {
  const Eigen::Matrix2d rotation = T_base_sensor.rotation();
  const Eigen::Vector2d mounting = T_base_sensor.translation();
  const auto& motion = scan.sensorMotion();
  const double duration = scan.duration();
  const bool jitters = scan.motion_noise.jitter != 0.0;
  Sweep sweep;
  sweep.reach = {scan.geometry()->rangeMin(), scan.geometry()->rangeMax()};
  readMotionNoise(scan, T_base_sensor, sweep);
  sweep.points.reserve(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    BeamPoint point;
    point.beam = i;
    const Eigen::Vector2d direction = scan.direction(i);
    const Eigen::Vector2d origin =
        motion.empty() ? Eigen::Vector2d(0.0, 0.0) : motion[i].translation();
    const Eigen::Vector2d position = scan.ranges()[i] * direction + origin;
    Eigen::Matrix2d covariance = scan.covariance(i, direction);
    if (jitters) covariance += jitterAt(position, scan.motion_noise);
    point.position = rotation * position + mounting;
    point.origin = rotation * origin + mounting;
    point.range = scan.ranges()[i];
    point.covariance = rotation * covariance * rotation.transpose();
    point.sweep_ratio = duration > 0.0 ? scan.geometry()->timeOffsets()[i] / duration : 0.0;
    sweep.points.push_back(point);
  }
  return sweep;
}

void makeIsotropic(Sweep& sweep, double sigma) {
  sweep.motion_noise = {};
  for (BeamPoint& point : sweep.points) {
    point.covariance = sigma * sigma * Eigen::Matrix2d::Identity();
  }
}

}  // namespace sightline::tracking
