#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sightline/geometry/angle.h"
#include "sightline/mapping/room_fitter.h"

namespace sightline::mapping {

namespace {

constexpr const char* kHead =
    R"(# Rooms fitted to a recording or a grid. Lengths in metres, angles in radians. Rename rooms, correct
# what is wrong. A rectangle has its middle and turn in the map, and its sides south, east, north, west
# at -y, +x, +y, -x of its own frame; a polygon has its corners in the map, counter-clockwise, and side
# 0 begins at the first. Spans say where wall was seen, from the start of a side on; sigma how well its
# line is known, across its middle and in turn, as standard deviations.
)";

std::string outline(const RoomOutline& room) {
  if (const auto r = rectangleOf(room)) {
    return fmt::format("    size: [{:.3f}, {:.3f}]\n    pose: [{:.3f}, {:.3f}, {:.5f}]\n",
                       r->size.x(), r->size.y(), r->pose.x(), r->pose.y(), r->pose.theta());
  }
  std::string corners;
  for (std::size_t i = 0; i < room.sides.size(); ++i) {
    const Eigen::Vector2d corner = room.side(i).start;
    corners += fmt::format("{}[{:.3f}, {:.3f}]", i == 0 ? "" : ", ", corner.x(), corner.y());
  }
  return fmt::format("    polygon: [{}]\n", corners);
}

std::string spansText(const std::vector<world::Span>& spans, double length) {
  std::string text;
  for (const world::Span& span : spans) {
    text += fmt::format("{}[{:.2f}, {:.2f}]", text.empty() ? "" : ", ", span.from,
                        std::min(span.to, length));
  }
  return text;
}

std::string wall(const RoomOutline& room, std::size_t i, const std::string& name) {
  const std::string where =
      room.spans[i].empty()
          ? "open: true"
          : fmt::format("spans: [{}]", spansText(room.spans[i], room.side(i).length()));
  if (!room.sides[i].is_seen) return fmt::format("      {}: {{{}}}  # not seen\n", name, where);
  const world::WallSigma sigma = sigmaOf(room, i);
  return fmt::format("      {}: {{{}, sigma: [{:.4f}, {:.5f}]}}  # {:.0f} mm, {:.2f} deg\n", name,
                     where, sigma.position, sigma.direction, 1e3 * sigma.position,
                     geometry::degrees(sigma.direction));
}

}  // namespace

std::string roomsText(const FittedRooms& fitted) {
  std::string text = std::string(kHead) + "rooms:\n";
  for (const RoomOutline& room : fitted.rooms) {
    const bool is_rectangle = rectangleOf(room).has_value();
    constexpr const char* kNames[] = {"south", "east", "north", "west"};
    text += fmt::format("  {}:\n{}    walls:\n", room.name, outline(room));
    for (std::size_t i = 0; i < room.sides.size(); ++i) {
      text += wall(room, i, is_rectangle ? kNames[i] : fmt::format("'{}'", i));
    }
  }
  if (fitted.doors.empty()) return text;
  text += "doors:\n";
  for (const FittedDoor& door : fitted.doors) {
    text += fmt::format("  - {{between: [{}, {}], at: [{:.3f}, {:.3f}], width: {:.2f}}}{}\n",
                        fitted.rooms[door.rooms[0]].name, fitted.rooms[door.rooms[1]].name,
                        door.centre_map.x(), door.centre_map.y(), door.width,
                        door.was_crossed ? "" : "  # seen, not passed");
  }
  return text;
}

}  // namespace sightline::mapping
