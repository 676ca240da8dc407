#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/mapping/room_outline.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// What a key scan sees of a side: the points' middle, and what lies one standard deviation to
/// either side of it, both on the line that fits them.
struct SideSighting {
  std::size_t key;
  std::size_t room;
  std::size_t side;
  Eigen::Vector2d ends_base[2];
  double sigma;  // of either end across the side [m]
};

/// Finds what key scans see of the sides of rooms.
class SightingFinder {
 public:
  /// @param gate  distance of a point from a side, at most [m]
  SightingFinder(const std::vector<RoomOutline>& rooms, double gate);

  /// Appends the sightings from a key scan at a pose.
  void find(std::size_t number, const KeyScan& key, const geometry::Pose2& pose,
            std::vector<SideSighting>& sightings) const;

 private:
  struct Target {
    std::size_t room;
    std::size_t side;
    Eigen::Vector2d start;
    Eigen::Vector2d normal;
    Eigen::Vector2d direction;
    double length;
  };
  std::optional<std::size_t> nearest(const Eigen::Vector2d& place,
                                     const Eigen::Vector2d& normal) const;

  double gate_;
  std::vector<Target> targets_;
};

}  // namespace sightline::mapping
