#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/motion/floor.h"
#include "sightline/scan/scan.h"

namespace sightline::motion {

/// Finds the beams that end on floor or ceiling where nobody knows the attitude.
///
/// A level surface meets the plane of a tilted scan in a straight line, `1 / r = a cos θ + b sin
/// θ`, with (a, b) the slope of that plane over the distance of the surface: `h / sin(max_tilt)`
/// away or more. A wall so far away looks the same, but stays where it is while the carrier nods.
/// Scans shortly before have seen it there, whereas a line on the floor they have seen through.
class FloorFinder {
 public:
  /// Throws config::Error if the configuration is out of range.
  explicit FloorFinder(const FloorConfig& config);

  /// Finds the beams of a scan made at this pose of the sensor that ended on floor or ceiling. The
  /// pose has to be good to some centimetres and a degree against those of the scans remembered.
  std::vector<bool> find(const scan::Scan& scan, const geometry::Pose2& T_odom_sensor) const;
  /// Keeps a scan, whole, to look back to.
  void remember(const scan::Scan& scan, const geometry::Pose2& T_odom_sensor);
  void forget() { memory_.clear(); }

 private:
  struct Remembered {
    scan::Scan scan;
    geometry::Pose2 T_odom_sensor;
  };
  using Beams = std::vector<std::size_t>;

  Beams farBeams(const scan::Scan& scan) const;
  std::optional<Eigen::Vector2d> bestSlope(const scan::Scan& scan, const Beams& beams) const;
  Beams floorOf(const scan::Scan& scan, const geometry::Pose2& T_odom_sensor,
                const Beams& line) const;

  FloorConfig config_;
  std::deque<Remembered> memory_;
};

}  // namespace sightline::motion
