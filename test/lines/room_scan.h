#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "monte_carlo.h"
#include "sightline/geometry/angle.h"
#include "sightline/geometry/segment.h"
#include "sightline/scan/scan.h"

namespace sightline::test {

/// Scans of a few walls, with noise.
struct ScanOf {
  std::vector<geometry::Segment> walls;  ///< in the world
  geometry::Pose2 pose;                  ///< of the sensor at the stamp
  double angle_min = -geometry::radians(135.0);
  double angle_increment = geometry::radians(0.25);
  std::size_t beams = 1081;
  double sigma = 0.01;
  double noise = 1.0;               ///< times sigma is what the ranges really err
  Eigen::Vector3d motion{0, 0, 0};  ///< of the sensor during the whole sweep: tangent of Pose2::exp

  scan::Scan take(Gauss& gauss) const {
    scan::Scan scan;
    scan.geometry =
        scan::ScanGeometry::uniform(angle_min, angle_increment, beams, 1e-5, 0.02, 60.0);
    scan.stamp = 1'000'000'000;
    scan.frame = "laser";
    for (std::size_t i = 0; i < beams; ++i) {
      const geometry::Pose2 moved = geometry::Pose2::exp(share(i) * motion);
      if (!motion.isZero()) scan.sensor_motion.push_back(moved);
      scan.ranges.push_back(range(pose * moved, scan.geometry->angles()[i]) + gauss(noise * sigma));
    }
    classify(scan);
    return scan;
  }

  void classify(scan::Scan& scan) const {
    scan.kinds.clear();
    for (const double r : scan.ranges) scan.kinds.push_back(scan::classify(r, *scan.geometry));
    scan.range_variances.assign(scan.ranges.size(), sigma * sigma);
  }

  double share(std::size_t i) const {
    return static_cast<double>(i) / static_cast<double>(beams - 1);
  }

  /// Infinite where nothing is met.
  double range(const geometry::Pose2& sensor, double angle) const {
    const double heading = sensor.theta() + angle;
    const Eigen::Vector2d direction(std::cos(heading), std::sin(heading));
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& wall : walls) {
      const Eigen::Vector2d normal = wall.leftNormal();
      const double facing = normal.dot(direction);
      if (facing == 0.0) continue;
      const double range = normal.dot(wall.start - sensor.translation()) / facing;
      const double along = wall.along(sensor.translation() + range * direction);
      if (range > 0.0 && range < nearest && along >= 0.0 && along <= wall.length()) nearest = range;
    }
    return nearest;
  }
};

inline std::vector<geometry::Segment> rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}}, {{x1, y0}, {x1, y1}}, {{x1, y1}, {x0, y1}}, {{x0, y1}, {x0, y0}}};
}

}  // namespace sightline::test
