#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sightline/geometry/pose2.h"

/// A robot that drives an arc through a rectangular room, as a CARMEN log would have it: the frame
/// of its odometry is the map.
namespace sightline::test {

constexpr double kRoomLength = 6.0;  // along x, centred on the origin [m]
constexpr double kRoomWidth = 4.0;   // along y [m]

constexpr const char* kRoomMap = "rooms:\n  hall: {size: [6.0, 4.0]}\n";

/// Pose of the robot at a time [s].
inline geometry::Pose2 carmenRobotAt(double time) {
  return geometry::Pose2(-1.5, -1.0, 0.2) * geometry::Pose2::exp({0.3 * time, 0.0, 0.1 * time});
}

inline double distanceToWall(const geometry::Pose2& laser, double angle) {
  const double direction = laser.theta() + angle;
  const auto along = [](double position, double cosine, double half) {
    if (cosine == 0.0) return std::numeric_limits<double>::infinity();
    return ((cosine > 0.0 ? half : -half) - position) / cosine;
  };
  return std::min(along(laser.x(), std::cos(direction), 0.5 * kRoomLength),
                  along(laser.y(), std::sin(direction), 0.5 * kRoomWidth));
}

inline std::string poseText(const geometry::Pose2& pose) {
  return fmt::format("{:.6f} {:.6f} {:.6f}", pose.x(), pose.y(), pose.theta());
}

/// One FLASER line of 181 beams, taken where the robot is at a time, and stamped with another.
inline std::string flaserLineAt(double time, double stamp) {
  const geometry::Pose2 robot = carmenRobotAt(time);
  std::string line = "FLASER 181";
  for (int i = 0; i < 181; ++i) {
    line += fmt::format(" {:.3f}", distanceToWall(robot, geometry::radians(i - 90.0)));
  }
  return line + fmt::format(" {0} {0} {1:.6f} host {1:.6f}\n", poseText(robot), 100.0 + stamp);
}

inline std::string flaserLine(double time) {
  return flaserLineAt(time, time);
}

inline std::string odomLine(double time) {
  return fmt::format("ODOM {} 0.3 0.1 0 {:.6f} host 0\n", poseText(carmenRobotAt(time)),
                     100.0 + time);
}

/// Scans at 5 Hz and odometry at 10 Hz, both from time 0 on; stamps start at 100 s.
inline std::string carmenRoomLog(int scans) {
  std::string log = "# CARMEN Logfile\nPARAM robot_front_laser_max 80.99 1 host 1\n";
  for (int i = 0; i < scans; ++i) {
    log += odomLine(0.2 * i) + flaserLine(0.2 * i) + odomLine(0.2 * i + 0.1);
  }
  return log;
}

}  // namespace sightline::test
