#include "sightline/motion/sweep.h"

#include <gtest/gtest.h>

namespace sightline::motion {
namespace {

using Eigen::Vector2d;
using geometry::Pose2;

std::shared_ptr<const scan::ScanGeometry> sweeping(double increment = 0.05) {
  return scan::ScanGeometry::uniform(-1.0, increment, 41, 0.002, 0.1, 30.0);
}

TEST(SweepMotion, IsEmptyForACarrierThatStands) {
  EXPECT_TRUE(sweepMotion(*sweeping(), Pose2(), Pose2(0.2, 0.1, 1.0)).empty());
}

TEST(SweepMotion, IsEmptyWhereAllBeamsAreTakenAtOnce) {
  const auto geometry = scan::ScanGeometry::uniform(-1.0, 0.05, 41, 0.0, 0.1, 30.0);
  EXPECT_TRUE(sweepMotion(*geometry, Pose2(0.1, 0.0, 0.0), Pose2()).empty());
}

TEST(SweepMotion, BeginsAtTheStampAndEndsWhereTheSensorEnds) {
  const Pose2 T_start_end(0.04, 0.01, 0.1);
  const Pose2 T_carrier_sensor(0.3, -0.1, 2.0);
  const auto poses = sweepMotion(*sweeping(), T_start_end, T_carrier_sensor);
  ASSERT_EQ(poses.size(), 41u);
  EXPECT_LT(poses.front().coordinates().norm(), 1e-15);
  const Pose2 end = T_carrier_sensor.inverse() * T_start_end * T_carrier_sensor;
  EXPECT_LT((poses.back().coordinates() - end.coordinates()).norm(), 1e-14);
}

// A carrier drives along an arc; each beam is aimed at where a static landmark really is from the
// sensor's true pose at that beam. Taken together, all beams must put it in one place.
TEST(SweepMotion, EveryBeamOfAMovingSensorSeesAStaticPointInOnePlace) {
  const Pose2 T_carrier_sensor(0.3, -0.1, 0.4);
  const Eigen::Vector3d velocity(0.5, 0.05, -1.0);  // per second
  const auto geometry = sweeping();
  const double duration = geometry->timeOffsets().back();
  const auto motion = sweepMotion(*geometry, Pose2::exp(duration * velocity), T_carrier_sensor);
  const Vector2d landmark_start(4.0, 1.0);  // in the carrier's frame at the stamp
  const Vector2d landmark_sensor = T_carrier_sensor.inverse() * landmark_start;

  for (std::size_t i = 0; i < geometry->beams(); ++i) {
    // Brute force: the carrier in steps of a microsecond.
    Pose2 T_start_now;
    const int steps = static_cast<int>(std::lround(geometry->timeOffsets()[i] / 1e-6));
    for (int k = 0; k < steps; ++k) T_start_now = T_start_now * Pose2(1e-6 * velocity);
    const Vector2d seen = (T_start_now * T_carrier_sensor).inverse() * landmark_start;
    EXPECT_LT((motion[i] * seen - landmark_sensor).norm(), 1e-6) << i;
  }
}

// The same through Scan: a beam straight at the landmark, its range as measured.
TEST(SweepMotion, ScanPutsPointsIntoTheFrameAtTheStamp) {
  const Pose2 T_carrier_sensor(0.3, -0.1, 0.4);
  const Pose2 T_start_end(0.05, 0.0, 0.08);
  const auto geometry = sweeping();
  const auto motion = sweepMotion(*geometry, T_start_end, T_carrier_sensor);
  std::vector<double> ranges;
  // A wall x = 3 in the sensor's frame at the stamp, met by each beam from where the sensor is.
  for (std::size_t i = 0; i < geometry->beams(); ++i) {
    const double heading = motion[i].theta() + geometry->angles()[i];
    ranges.push_back((3.0 - motion[i].x()) / std::cos(heading));
  }
  scan::Scan scan(geometry, 0, std::move(ranges));
  scan.setSensorMotion(motion);
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    EXPECT_NEAR(scan.point(i).x(), 3.0, 1e-12);
  }
}

TEST(SweepMotion, FollowsTimesThatAreNeitherEvenNorInOrder) {
  const scan::ScanGeometry geometry({-1.0, 0.0, 0.5, 1.0}, {0.0, 0.03, 0.01, 0.04}, 0.1, 30.0);
  const auto poses = sweepMotion(geometry, Pose2(0.08, 0.0, 0.0), Pose2());
  ASSERT_EQ(poses.size(), 4u);
  EXPECT_NEAR(poses[1].x(), 0.06, 1e-15);
  EXPECT_NEAR(poses[2].x(), 0.02, 1e-15);
}

}  // namespace
}  // namespace sightline::motion
