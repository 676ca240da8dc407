// Any text, read as a map of rooms: a map whose questions can be asked, or config::Error.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sightline/world/room_map.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sightline;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const world::RoomMap map(config::Node::parse(text, "fuzz"));
    const Eigen::Vector2d point(1.0, 0.5);
    for (const world::Door& door : map.doors()) {
      if (!map.doorBetween(door.rooms[0], door.rooms[1], point)) std::abort();
    }
    if (!map.rooms().empty() && map.nearestRoom(point) >= map.rooms().size()) std::abort();
    for (const world::Room& room : map.rooms()) {
      if (!map.find(room.name) || !(room.distance(point) >= 0.0)) std::abort();
    }
  } catch (const config::Error&) {
  }
  return 0;
}
