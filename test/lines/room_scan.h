#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "monte_carlo.h"
#include "sightline/geometry/angle.h"
#include "sightline/geometry/segment.h"
#include "sightline/scan/noise_model.h"
#include "sightline/scan/scan.h"

namespace sightline::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Scans of a few walls and round posts, with noise.
struct ScanOf {
  struct Post {
    Eigen::Vector2d centre;
    double radius;
  };

  std::vector<geometry::Segment> walls{};  ///< in the world
  std::vector<Post> posts{};
  geometry::Pose2 pose{};  ///< of the sensor at the stamp
  double angle_min = -geometry::radians(135.0);
  double angle_increment = geometry::radians(0.25);
  std::size_t beams = 1081;
  scan::NoiseModel noise{};  ///< what the ranges err by, and the scan knows of
  double range_max = 60.0;
  Eigen::Vector3d motion{0, 0, 0};  ///< of the sensor during the sweep: tangent of Pose2::exp

  scan::Scan take(Gauss& gauss) const { return take(&gauss); }
  scan::Scan takeWithoutNoise() const { return take(nullptr); }

  /// The scan that these ranges make [m].
  scan::Scan withRanges(std::vector<double> ranges) const {
    scan::Scan scan(
        scan::ScanGeometry::uniform(angle_min, angle_increment, beams, 1e-5, 0.02, range_max),
        1'000'000'000, std::move(ranges));
    scan.frame = "laser";
    scan::applyNoise(noise, scan);
    return scan;
  }

  /// Range that the beam sees; infinite where it meets nothing.
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
    for (const Post& post : posts) {
      const Eigen::Vector2d offset = post.centre - sensor.translation();
      const double middle = offset.dot(direction);
      const double square = post.radius * post.radius - offset.squaredNorm() + middle * middle;
      if (square < 0.0) continue;
      const double range = middle - std::sqrt(square);
      if (range > 0.0 && range < nearest) nearest = range;
    }
    return nearest;
  }

 private:
  scan::Scan take(Gauss* gauss) const {
    std::vector<double> ranges;
    std::vector<geometry::Pose2> moved;
    for (std::size_t i = 0; i < beams; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(beams - 1);
      moved.push_back(geometry::Pose2::exp(share * motion));
      const double angle =
          i == 0 ? angle_min : angle_min + static_cast<double>(i) * angle_increment;
      ranges.push_back(measure(pose * moved.back(), angle, gauss));
    }
    scan::Scan scan = withRanges(std::move(ranges));
    if (!motion.isZero()) scan.setSensorMotion(std::move(moved));
    return scan;
  }

  double measure(const geometry::Pose2& sensor, double angle, Gauss* gauss) const {
    if (!gauss) return range(sensor, angle);
    const double turned = angle + (*gauss)(std::sqrt(noise.angularVariance()));
    const double true_range = range(sensor, turned);
    return true_range + (*gauss)(std::sqrt(noise.rangeVariance(true_range)));
  }
};

inline std::vector<geometry::Segment> rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}}, {{x1, y0}, {x1, y1}}, {{x1, y1}, {x0, y1}}, {{x0, y1}, {x0, y0}}};
}

/// Seen from the origin with 270°, a rectangle in five segments: the blind sector takes the middle
/// out of the wall behind the sensor.
inline ScanOf room() {
  ScanOf scan;
  scan.walls = rectangle(-1.0, -2.5, 4.0, 2.0);
  return scan;
}

/// A single wall on the line y = distance, between two places on it.
inline ScanOf wallAhead(double distance, double from, double to) {
  ScanOf scan;
  scan.walls = {{{from, distance}, {to, distance}}};
  scan.angle_min = 0.0;
  scan.beams = 721;  // half a turn
  return scan;
}

}  // namespace sightline::test
