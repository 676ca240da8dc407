#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sightline/geometry/stamped_pose2.h"
#include "sightline/mapping/room_outline.h"
#include "sightline/mapping/side_evidence.h"

namespace sightline::mapping {

/// An opening between two rooms.
struct FittedDoor {
  std::size_t rooms[2] = {0, 0};
  std::size_t sides[2] = {0, 0};
  Eigen::Vector2d centre_map = Eigen::Vector2d::Zero();
  double width = 0.0;                                        ///< [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of the centre [m²]
  bool was_crossed = false;
};

/// A place where the path goes from one room to another.
struct Crossing {
  std::size_t rooms[2] = {0, 0};
  Eigen::Vector2d left_map = Eigen::Vector2d::Zero();     ///< last place in the first
  Eigen::Vector2d entered_map = Eigen::Vector2d::Zero();  ///< first place in the second
};

struct FoundDoors {
  std::vector<FittedDoor> doors;
  std::vector<Crossing> missing;  ///< crossings without a door: their rooms lie too far apart
};

/// Crossings of a path between rooms. A pause of a minute and more tells nothing of the way.
std::vector<Crossing> crossingsOf(const std::vector<geometry::StampedPose2>& path,
                                  const std::vector<RoomOutline>& rooms);

/// Finds doors where the path crosses from room to room, each as wide as the gap in the walls of
/// both, and where rays go through a gap between two walls into another room.
FoundDoors findDoors(const std::vector<Crossing>& crossings, const std::vector<RoomOutline>& rooms,
                     const std::vector<std::vector<SideEvidence>>& evidence);

}  // namespace sightline::mapping
