#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sightline/geometry/stamped_pose2.h"
#include "sightline/mapping/door_finder.h"
#include "sightline/mapping/grid_survey.h"
#include "sightline/mapping/path_adjuster.h"
#include "sightline/mapping/room_outline.h"
#include "sightline/mapping/survey.h"
#include "sightline/world/room_map.h"

namespace sightline::mapping {

/// Rooms of a recording, with the path that they were seen from.
struct FittedRooms {
  std::vector<RoomOutline> rooms;
  std::vector<FittedDoor> doors;
  std::vector<Crossing> missing_doors;
  AdjustedPath path;
  std::vector<geometry::StampedPose2> poses;  ///< of all scans, T_map_base
  double inside = 0.0;                        ///< share of the path that lies in a room
};

/// Fits rooms to a recording: closes the loops of its path, finds rectangles, adjusts walls and
/// path together, and finds the spans of the walls and the doors. No rooms where nothing was found.
FittedRooms fitRooms(const Survey& survey, const Progress& progress);

/// The same of a grid. Walls are known to a part of a cell at best, as all that is seen of one may
/// lie on one side of the middle of its cells.
FittedRooms fitRooms(const GridSurvey& survey, const Progress& progress);

/// The text of a rooms file for people, which world::RoomMap reads: millimetres, and how certain
/// each wall is, as comments.
std::string roomsText(const FittedRooms& fitted);

}  // namespace sightline::mapping
