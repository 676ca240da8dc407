#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "sightline/geometry/stamped_pose2.h"

namespace sightline::logs {

/// Poses in the order of their stamps.
using Trajectory = std::vector<geometry::StampedPose2>;

/// Reads a trajectory in the TUM format, `t x y z qx qy qz qw` a line (of which height and tilt are
/// left out), or the same with `t x y theta`; metres, radians, `#` starts a comment. Throws
/// config::Error with file and line.
Trajectory readTrajectory(const std::string& path);

/// Writes a trajectory in the TUM format, pose by pose.
class TrajectoryWriter {
 public:
  /// Throws config::Error if the file cannot be written.
  explicit TrajectoryWriter(const std::string& path);

  void add(std::int64_t stamp, const geometry::Pose2& pose);
  /// Ends the file; call it at the end. Throws config::Error if not all could be written.
  void close();

 private:
  std::string path_;
  std::ofstream file_;
};

/// Motion of something between two times, known from elsewhere.
struct Relation {
  std::int64_t first = 0;   ///< [ns]
  std::int64_t second = 0;  ///< [ns]
  geometry::Pose2 motion;   ///< pose at the second time in the frame of that at the first
};

/// Reads `t1 t2 x y z roll pitch yaw` a line (Kümmerle, Burgard et al. 2009); height and tilt are
/// left out. Throws config::Error with file and line.
std::vector<Relation> readRelations(const std::string& path);

}  // namespace sightline::logs
