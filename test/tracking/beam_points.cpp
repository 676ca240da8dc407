#include "sightline/tracking/beam_points.h"

#include <cmath>

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "sightline/motion/sweep.h"
#include "sightline/motion/sweep_noise.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

const Pose2 kBaseSensor(0.4, -0.2, 0.9);

// Three beams over a tenth of a second, of a head that turns on a robot that drives.
scan::Scan threeBeams(const Pose2& T_start_end_base, const Pose2& T_base_sensor_end) {
  scan::Scan scan(
      std::make_shared<scan::ScanGeometry>(std::vector<double>{-0.5, 0.0, 0.5},
                                           std::vector<double>{0.0, 0.05, 0.1}, 0.1, 30.0),
      1, {2.0, 3.0, 4.0});
  const Pose2 end = kBaseSensor.inverse() * T_start_end_base * T_base_sensor_end;
  scan.setSensorMotion({Pose2(), geometry::interpolate({}, end, 0.5), end});
  return scan;
}

// The noise of the base's motion, as the sensor's, comes back as the base's, however the head
// turned meanwhile: the error that it predicts for the last beam's point is that of many robots.
TEST(ReadSweep, MotionNoiseOfATurningHeadIsTheBases) {
  const Pose2 motion(0.05, 0.01, 0.08);
  const Pose2 head_end = kBaseSensor * Pose2(0.0, 0.0, 0.4);
  const Eigen::Matrix3d P =
      (Eigen::Matrix3d() << 4e-4, 0, 1e-4, 0, 1e-4, 0, 1e-4, 0, 9e-4).finished();
  const auto sensor_end = [&](const Pose2& base) {
    return kBaseSensor.inverse() * base * head_end;
  };
  test::Gauss gauss(4);
  test::Moments<3> of_sensor;
  test::Moments<3> of_base;
  test::Moments<2> of_point;
  scan::Scan scan = threeBeams(motion, head_end);
  const Eigen::Vector2d last = 4.0 * Eigen::Vector2d(std::cos(0.5), std::sin(0.5));
  for (int i = 0; i < 60000; ++i) {
    const Pose2 base(motion.coordinates() + gauss(P));
    of_sensor.add(sensor_end(base).coordinates());
    of_base.add((base * motion.inverse()).log());
    of_point.add(kBaseSensor * sensor_end(base) * last);
  }
  scan.motion_noise.drift = of_sensor.covariance();
  const Sweep sweep = readSweep(scan, kBaseSensor);
  EXPECT_LT(test::relativeError<3>(of_base.covariance(), sweep.motion_noise.atEnd()), 0.03);
  const Eigen::Vector2d point = sweep.points[2].position;
  Eigen::Matrix<double, 2, 3> by_twist;
  by_twist << 1.0, 0.0, -point.y(), 0.0, 1.0, point.x();
  const Eigen::Matrix2d predicted = by_twist * sweep.motion_noise.atEnd() * by_twist.transpose();
  EXPECT_LT(test::relativeError<2>(of_point.covariance(), predicted), 0.03);
}

TEST(ReadSweep, WalkEndsLikeADriftOfItsCovariance) {
  const Pose2 motion(0.05, 0.01, 0.08);
  scan::Scan scan = threeBeams(motion, kBaseSensor);
  scan.motion_noise = motion::sweepNoise({}, motion, kBaseSensor, 0.1);
  scan.motion_noise.walk += scan.motion_noise.drift;
  scan.motion_noise.drift.setZero();
  const Sweep walk = readSweep(scan, kBaseSensor);
  std::swap(scan.motion_noise.walk, scan.motion_noise.drift);
  const Sweep drift = readSweep(scan, kBaseSensor);
  EXPECT_TRUE(drift.motion_noise.drift.isApprox(walk.motion_noise.walk, 1e-12));
  EXPECT_TRUE(drift.motion_noise.walk.isZero());
  EXPECT_FALSE(walk.motion_noise.walk.isZero());
  EXPECT_DOUBLE_EQ(walk.points[1].sweep_ratio, 0.5);
}

TEST(ReadSweep, JitterWidensBeamsAcrossTheirDistanceFromTheAxis) {
  scan::Scan scan = threeBeams({}, kBaseSensor);
  const Sweep still = readSweep(scan, kBaseSensor);
  scan.motion_noise.jitter = 1e-4;
  scan.motion_noise.jitter_axis = {-0.1, 0.05};
  const Sweep sweep = readSweep(scan, kBaseSensor);
  test::Gauss gauss(9);
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d arm = scan.point(i) - scan.motion_noise.jitter_axis;
    test::Moments<2> moments;
    for (int draw = 0; draw < 20000; ++draw) {
      const Pose2 turned(0.0, 0.0, gauss(0.01));
      moments.add(kBaseSensor.rotation() * (turned * arm) + gauss(still.points[i].covariance));
    }
    EXPECT_LT(test::relativeError<2>(moments.covariance(), sweep.points[i].covariance), 0.03);
  }
  EXPECT_TRUE(sweep.motion_noise.atEnd().isZero());
}

TEST(ReadSweep, IsotropicNoiseReplacesTheScans) {
  scan::Scan scan = threeBeams({}, kBaseSensor);
  scan.motion_noise.drift.setIdentity();
  Sweep sweep = readSweep(scan, kBaseSensor);
  makeIsotropic(sweep, 0.05);
  EXPECT_TRUE(sweep.motion_noise.atEnd().isZero());
  for (const BeamPoint& point : sweep.points) {
    EXPECT_TRUE(point.covariance.isApprox(0.0025 * Eigen::Matrix2d::Identity()));
  }
}

}  // namespace
}  // namespace sightline::tracking
