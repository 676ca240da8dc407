#include "sightline/pipeline/turn_sense.h"

#include <gtest/gtest.h>

#include "dead_reckoning/simulated_scans.h"

namespace sightline::pipeline {
namespace {

using geometry::Pose2;

// The scans of a driver that names the beams in the wrong order.
scan::Scan mirrored(const scan::Scan& scan) {
  std::vector<double> ranges(scan.ranges().rbegin(), scan.ranges().rend());
  return scan::Scan(scan.geometry(), scan.stamp, std::move(ranges));
}

struct Drive {
  double turn_rate = 0.4;
  double odometry_sign = 1.0;  // of the turns
  bool is_mirrored = false;
};

bool isOpposite(const Drive& drive) {
  TurnSense sense;
  const Pose2 T_base_sensor(0.2, 0.1, 0.3);
  test::Viewer viewer(test::furnishedRoom(), test::scanner(271, 1.5 * geometry::kPi), 1);
  for (int i = 0; i < 200; ++i) {
    const double time = 0.1 * i;
    const auto twist = Eigen::Vector3d(0.2, 0.0, drive.turn_rate * std::sin(0.5 * time));
    const double heading = 2.0 * drive.turn_rate * (1.0 - std::cos(0.5 * time));
    const Pose2 T_map_base(-0.5 + 0.1 * std::sin(time), 0.5, heading);
    const Pose2 T_odom_base(T_map_base.x(), drive.odometry_sign * T_map_base.y(),
                            drive.odometry_sign * heading);
    const scan::Scan scan = viewer.look(T_map_base * T_base_sensor, time, twist);
    sense.add(drive.is_mirrored ? mirrored(scan) : scan, T_odom_base, T_base_sensor);
  }
  return sense.isOpposite();
}

TEST(TurnSense, AScannerThatAgreesWithTheOdometryIsNotAccused) {
  EXPECT_FALSE(isOpposite({}));
  EXPECT_FALSE(isOpposite({0.0, 1.0, true})) << "without turns nothing is known";
}

TEST(TurnSense, FindsMirroredScansAndOdometryThatTurnsTheWrongWay) {
  EXPECT_TRUE(isOpposite({0.4, 1.0, true}));
  EXPECT_TRUE(isOpposite({0.4, -1.0, false}));
  EXPECT_FALSE(isOpposite({0.4, -1.0, true})) << "both are mirrored, and agree";
}

}  // namespace
}  // namespace sightline::pipeline
