#pragma once

#include <string>

#include "sightline/geometry/pose2.h"
#include "sightline/world/occupancy.h"

namespace sightline::mapping {

/// A map of a map_server: cells, and where their corner lies.
struct GridMap {
  world::Occupancy cells;      ///< its origin is zero: cell (0, 0) begins there
  geometry::Pose2 T_map_grid;  ///< of that corner, with the turn of the cells
  std::string path;            ///< of the file, for messages
};

/// Reads the YAML file of a map_server and the image that it names (pgm, png and others), by the
/// rules of the map_server: a cell is occupied or free where its darkness is above the one
/// threshold or below the other, unknown between. Throws config::Error with file, line and key,
/// also where no cell is free or none is occupied.
GridMap readGridMap(const std::string& path);

}  // namespace sightline::mapping
