#pragma once

#include <string>

#include "sightline/world/room_map.h"

namespace sightline::world {

/// The text of a rooms file that reads back as the same map, to the last bit. Walls whose spans
/// doors have cut are written as they are left: the doors cut nothing more from them.
std::string toYaml(const RoomMap& map);

/// Throws config::Error with the path where it cannot be written.
void writeFile(const RoomMap& map, const std::string& path);

}  // namespace sightline::world
