#pragma once

#include <cstddef>
#include <vector>

#include "sightline/gaze/gaze_config.h"
#include "sightline/gaze/wall_visibility.h"
#include "sightline/geometry/pose2.h"
#include "sightline/world/room_map.h"
#include "sightline/world/room_view.h"

namespace sightline::gaze {

/// Where a look is to be chosen from.
struct LookingPlace {
  geometry::UncertainPose2 T_map_base;
  geometry::Pose2 T_base_mount;
  std::size_t room = 0;  ///< of the map
  double head_angle = 0.0;
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();  ///< of the base, in its frame [m/s, m/s, rad/s]
};

/// Head angle, and what is expected of it.
struct Look {
  double angle = 0.0;      ///< [rad]
  double drop = 0.0;       ///< of the variances of x and y together, a second [m²/s]
  bool has_walls = false;  ///< whether any wall of the map is in reach of any angle
};

/// Finds the head angle from which the covariance of the pose drops fastest: over the walls of the
/// map that would be in view, through doors too, at the range's noise and with the map's errors,
/// from where the carrier will be when the head has got there; the time of the way counts.
class InformativeGaze {
 public:
  /// `config` has to live as long.
  explicit InformativeGaze(const GazeConfig& config) : config_(&config) {}

  Look choose(const LookingPlace& place, const world::RoomMap& map,
              const WallVisibility& visibility) const;
  /// Information about (x, y, θ) of the base in the map that one scan brings at a head angle.
  Eigen::Matrix3d information(const LookingPlace& place, double head_angle,
                              const world::RoomMap& map, const WallVisibility& visibility) const;
  /// Time in which the head gets from one angle to another [s].
  double travelTime(double from, double to) const;

 private:
  // A beam that meets a wall.
  struct Ray {
    world::WallIndex wall;
    double bearing;            // in the mount's frame [rad]
    double along;              // the wall [m]
    Eigen::Vector3d response;  // of the distance from the wall, to (x, y, θ)
    double weight;             // inverse variance of that distance, of all beams it is for
  };
  std::vector<Ray> cast(const LookingPlace& place, const world::RoomMap& map,
                        const WallVisibility& visibility) const;
  Eigen::Matrix3d informationOf(const std::vector<Ray>& rays, double head_angle) const;
  double rate(const LookingPlace& place, const Eigen::Matrix3d& information, double travel) const;

  const GazeConfig* config_;
};

}  // namespace sightline::gaze
