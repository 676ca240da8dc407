#pragma once

#include <vector>

#include "sightline/gaze/gaze_config.h"
#include "sightline/gaze/pose_uncertainty.h"
#include "sightline/gaze/wall_visibility.h"
#include "sightline/geometry/pose2.h"
#include "sightline/world/room_map.h"
#include "sightline/world/room_view.h"

namespace sightline::gaze {

/// Where a look is to be chosen from.
struct LookingPlace {
  geometry::Pose2 T_map_base;
  PoseUncertainty uncertainty{Eigen::Matrix3d::Zero(), Eigen::Vector2d::Zero()};
  geometry::Pose2 T_base_mount;
  std::size_t room = 0;  ///< of the map
  double head_angle = 0.0;
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();  ///< of the base, in its frame [m/s, m/s, rad/s]
  double scan_period = 0.1;                         ///< of the sensor [s]
};

/// Head angle, and what is expected of it.
struct Look {
  double angle = 0.0;      ///< [rad]
  double variance = 0.0;   ///< of x and y together, on average over the time ahead [m²]
  bool has_walls = false;  ///< whether any wall of the map is in reach of any angle
};

/// Finds the head angle with which the position will be the most certain on average over the time
/// ahead: over the walls of the map that would be in view from where the carrier will be, through
/// doors too, at the noise of the ranges and with the errors of the map, which another look at the
/// same wall does not take away. What is seen on the head's way counts, as the time of it does.
class InformativeGaze {
 public:
  /// `config` has to live as long.
  explicit InformativeGaze(const GazeConfig& config) : config_(&config) {}

  Look choose(const LookingPlace& place, const world::RoomMap& map,
              const WallVisibility& visibility) const;
  /// What one scan at a head angle is expected to say of the walls, from where the carrier is now.
  std::vector<WallLook> looksAt(const LookingPlace& place, double head_angle,
                                const world::RoomMap& map, const WallVisibility& visibility) const;
  /// Time in which the head gets from one angle to another [s].
  double travelTime(double from, double to) const;

 private:
  // A direction in which a wall is.
  struct Ray {
    double heading;  // in the map [rad]
    world::Sighting sighting;
    double weight;  // inverse variance of the range, of all beams it is for [1/m²]
  };
  std::vector<Ray> cast(const LookingPlace& place, const geometry::Pose2& T_map_base,
                        const world::RoomMap& map, const WallVisibility& visibility) const;
  // What is seen of the walls in a direction of the middle of the field.
  void look(const std::vector<Ray>& rays, double heading, WallLooks& looks) const;
  double expectedVariance(const LookingPlace& place, const std::vector<Ray>& rays, double angle,
                          WallLooks& looks) const;
  double angleAfter(double from, double to, double time) const;

  const GazeConfig* config_;
};

}  // namespace sightline::gaze
