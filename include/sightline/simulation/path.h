#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/config/fields.h"
#include "sightline/geometry/pose2.h"
#include "sightline/simulation/robot.h"

namespace sightline::simulation {

/// A way to drive, from wherever the robot stands.
///
/// ```yaml
/// wait: 2.0                           # s, before it sets off
/// speed: 0.6                          # m/s
/// turn_rate: 0.8                      # rad/s, at most
/// tolerance: 0.3                      # m; this near to a waypoint the next one is headed for
/// repeat: false                       # whether the first waypoint comes after the last one
/// waypoints: [[1.0, 2.0], [1.0, 0.0]] # m, in the map
/// ```
struct Path {
  double wait = 0.0;
  double speed = 0.6;
  double turn_rate = 0.8;
  double tolerance = 0.3;
  bool repeat = false;
  std::vector<Eigen::Vector2d> waypoints_map;

  Path() = default;
  /// Throws config::Error with file, line and key.
  explicit Path(const config::Node& document);
  /// Visits all but the waypoints, which have no default.
  void visit(config::FieldVisitor& visitor);
  static Path readFile(const std::string& path) { return Path(config::Node::readFile(path)); }
};

/// Steers along a path: turns towards the next waypoint, slower the more it has to turn, and stays
/// at the last one, if there is one.
class PathFollower {
 public:
  /// `acceleration` [m/s²] is what the robot brakes with.
  PathFollower(Path path, double acceleration);

  /// The velocity to want at a pose; to be called once a step.
  Velocity steer(const geometry::Pose2& T_map_base);
  bool hasArrived() const { return next_ == path_.waypoints_map.size(); }

 private:
  Velocity towards(const Eigen::Vector2d& target_base) const;
  bool isLast() const { return !path_.repeat && next_ + 1 == path_.waypoints_map.size(); }
  bool isPassed(const Eigen::Vector2d& target_base) const;

  Path path_;
  double acceleration_;
  std::size_t next_ = 0;
};

}  // namespace sightline::simulation
