#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "sightline/geometry/stamped_pose2.h"
#include "sightline/mapping/recorded_tracker.h"

namespace sightline::mapping {

/// Use of a wall in a replay.
struct WallUse {
  std::size_t used = 0;     ///< scans in which it corrected the pose
  std::size_t refused = 0;  ///< scans in which it was found elsewhere than expected
  double residual = 0.0;  ///< sum of the distances at which it was found, of the scans that used it
  double meanResidual() const { return used == 0 ? 0.0 : residual / static_cast<double>(used); }
};

/// A time in which the tracker was away from the path.
struct LostPlace {
  double begin = 0.0;  ///< since the first scan [s]
  double seconds = 0.0;
  Eigen::Vector2d position_map = Eigen::Vector2d::Zero();  ///< of the path where it began
};

/// The room tracker over a recording on rooms that were fitted to it, held against the fitted path:
/// rooms that lose their own recording are no map.
class Replay {
 public:
  /// The map is that of `config.rooms`, the start that of the path. Throws config::Error.
  Replay(pipeline::EstimatorsConfig config, std::vector<geometry::StampedPose2> path,
         std::vector<geometry::StampedPose2> odometry);

  /// Takes a scan of the recording. Where it brings no odometry that of dead reckoning is used.
  void take(pipeline::LocatedScan located);
  /// Ends a place that is still lost.
  void finish();

  std::size_t scans() const { return scans_; }
  /// Share of the scans within 0.25 m and 10° of the path.
  double rightShare() const;
  double meanDifference() const;  ///< of position, of the scans within [m]
  double maxDifference() const { return most_; }
  /// Whether the rooms keep the robot: all but 2 % of the scans are right, and none of the others
  /// last longer than 3 s.
  bool isGood() const;
  /// Places that were lost for a second and more, the longest first.
  std::vector<LostPlace> lostPlaces() const;
  /// By room and wall.
  const std::map<std::pair<std::size_t, std::size_t>, WallUse>& walls() const { return walls_; }
  const world::RoomMap& map() { return tracker_.map(); }

 private:
  void judge(std::int64_t stamp, const geometry::Pose2& difference, const geometry::Pose2& truth);
  void count(const tracking::TrackerUpdate& update);

  std::vector<geometry::StampedPose2> path_;
  RecordedTracker tracker_;
  std::size_t scans_ = 0;
  std::size_t right_ = 0;
  double sum_ = 0.0;
  double most_ = 0.0;
  bool is_lost_ = false;
  std::int64_t last_ = 0;
  std::vector<LostPlace> lost_;
  std::map<std::pair<std::size_t, std::size_t>, WallUse> walls_;
};

}  // namespace sightline::mapping
