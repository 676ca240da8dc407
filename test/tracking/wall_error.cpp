#include "sightline/tracking/wall_error.h"

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "sightline/tracking/pose_filter.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;
using geometry::Segment;
using Motion = LineBySweepError;

// A wall whose middle is off along its normal, and which is turned about its middle.
Segment shifted(const Segment& wall, double offset, double turn) {
  const Eigen::Vector2d middle = wall.midpoint() + offset * wall.leftNormal();
  const Eigen::Vector2d half = Pose2(0.0, 0.0, turn) * Eigen::Vector2d(wall.end - wall.midpoint());
  return {middle - half, middle + half};
}

const std::vector<Segment> kSides{{{-3.0, -2.0}, {3.0, -2.0}},
                                  {{3.0, -2.0}, {3.0, 2.0}},
                                  {{3.0, 2.0}, {-3.0, 2.0}},
                                  {{-3.0, 2.0}, {-3.0, -2.0}}};

TEST(WallError, JacobianIsTheDerivativeOfTheLine) {
  constexpr double kStep = 1e-6;
  for (const Segment& shape : kSides) {
    const Segment wall = Pose2(4.0, 7.0, 0.4) * shape;
    const WallError error({0, 0}, wall, {});
    const Eigen::Vector2d by_offset =
        geometry::difference(shifted(wall, kStep, 0.0).line(), wall.line()) / kStep;
    const Eigen::Vector2d by_turn =
        geometry::difference(shifted(wall, 0.0, kStep).line(), wall.line()) / kStep;
    EXPECT_LT((error.line_jacobian.col(0) - by_offset).norm(), 1e-4);
    EXPECT_LT((error.line_jacobian.col(1) - by_turn).norm(), 1e-4);
  }
}

// Mean NEES of robots in rooms that are drawn wrong, after these many scans on a way of this step.
double neesInWrongRooms(int scans, const Pose2& step) {
  WallConfig config;
  config.position_sigma = 0.02;
  config.direction_sigma = 0.005;
  const auto odometry = motion::OdometryNoise::unmeasured();
  const Eigen::Matrix3d start = Eigen::Vector3d(0.01, 0.01, 0.002).asDiagonal();
  test::Gauss gauss(11);
  constexpr int kRobots = 1000;
  double sum = 0.0;
  for (int robot = 0; robot < kRobots; ++robot) {
    std::vector<Segment> real;
    for (const Segment& wall : kSides) real.push_back(shifted(wall, gauss(0.02), gauss(0.005)));
    Pose2 truth(-1.0, 0.5, 0.3);
    PoseFilter filter(odometry, {Pose2(truth.coordinates() + gauss(start)), start});
    for (int i = 0; i < scans; ++i) {
      const Pose2 reported(step.coordinates());
      filter.predict(odometry, reported);
      const Eigen::Matrix3d noise = motion::stepCovariance(odometry, reported);
      truth = truth * Pose2(reported.coordinates() + gauss(noise));
      for (std::size_t k = 0; k < kSides.size(); ++k) {
        geometry::PolarLine measured = geometry::transform(truth.inverse(), real[k].line());
        measured.rho += gauss(0.002);
        measured.phi += gauss(0.001);
        measured.covariance = Eigen::Vector2d(4e-6, 1e-6).asDiagonal();
        filter.update(filter.innovation(measured, kSides[k].line(), Motion::Zero(),
                                        WallError({0, k}, kSides[k], config)));
      }
    }
    Eigen::Vector3d error = filter.pose().mean.coordinates() - truth.coordinates();
    error[2] = geometry::wrapAngle(error[2]);
    sum += test::normalisedSquare<3>(error, filter.pose().covariance);
  }
  return sum / kRobots;
}

TEST(WallError, AnHourAtRestAveragesNoErrorOfTheMapOut) {
  EXPECT_NEAR(neesInWrongRooms(200, {}), 3.0, 0.4);
}

TEST(WallError, NorDoesAWayThroughTheRoom) {
  EXPECT_NEAR(neesInWrongRooms(30, {0.05, 0.0, 0.03}), 3.0, 0.4);
}

}  // namespace
}  // namespace sightline::tracking
