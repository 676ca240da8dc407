#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sightline/geometry/angle.h"
#include "sightline/mapping/room_fitter.h"

namespace sightline::mapping {

namespace {

constexpr const char* kHead =
    "# Rooms fitted to a recording. Lengths in metres, angles in radians. Rename rooms, correct "
    "what "
    "is wrong.\n"
    "# A rectangle has its middle and turn in the map, and its sides south, east, north, west at "
    "-y, "
    "+x, +y, -x of its\n"
    "# own frame; a polygon has its corners in the map, counter-clockwise, and side 0 begins at "
    "the "
    "first. Spans say\n"
    "# where wall was seen, from the start of a side on. Behind each side: its standard "
    "deviations, "
    "across and in turn.\n";

// A side that bends away from its rectangle by less is a side of it [m].
constexpr double kSquare = 0.01;

struct Rectangle {
  geometry::Pose2 pose;
  Eigen::Vector2d size;
};

// The rectangle through the middles of the sides, turned as they are on average.
Rectangle rectangleOf(const RoomOutline& room) {
  double turn = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double expected = room.sides[0].angle + 0.5 * geometry::kPi * static_cast<double>(i);
    turn += 0.25 * geometry::wrapAngle(room.sides[i].angle - expected);
  }
  turn = geometry::wrapAngle(turn + room.sides[0].angle - 0.5 * geometry::kPi);
  const geometry::Pose2 turned(0.0, 0.0, turn);
  const auto middle = [&](std::size_t i) {
    return Eigen::Vector2d(turned.inverse() * room.side(i).midpoint());
  };
  const Eigen::Vector2d low(middle(3).x(), middle(0).y());
  const Eigen::Vector2d high(middle(1).x(), middle(2).y());
  return {{turned * Eigen::Vector2d(0.5 * (low + high)), turn}, high - low};
}

bool isRectangle(const RoomOutline& room) {
  if (room.sides.size() != 4) return false;
  const Rectangle rectangle = rectangleOf(room);
  const Eigen::Vector2d half = 0.5 * rectangle.size;
  const Eigen::Vector2d corners[4] = {
      {-half.x(), -half.y()}, {half.x(), -half.y()}, half, {-half.x(), half.y()}};
  for (std::size_t i = 0; i < 4; ++i) {
    if ((rectangle.pose * corners[i] - room.side(i).start).norm() > kSquare) return false;
  }
  return true;
}

std::string outline(const RoomOutline& room) {
  if (isRectangle(room)) {
    const Rectangle r = rectangleOf(room);
    return fmt::format("    size: [{:.3f}, {:.3f}]\n    pose: [{:.3f}, {:.3f}, {:.5f}]\n",
                       r.size.x(), r.size.y(), r.pose.x(), r.pose.y(), r.pose.theta());
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
  const SideLine& side = room.sides[i];
  const std::string certainty =
      side.is_seen ? fmt::format("{:.0f} mm, {:.2f} deg", 1e3 * std::sqrt(side.covariance(0, 0)),
                                 geometry::degrees(std::sqrt(side.covariance(1, 1))))
                   : "not seen";
  const std::string key =
      room.spans[i].empty()
          ? "{open: true}"
          : fmt::format("{{spans: [{}]}}", spansText(room.spans[i], room.side(i).length()));
  return fmt::format("      {}: {}  # {}\n", name, key, certainty);
}

}  // namespace

std::string roomsText(const FittedRooms& fitted) {
  std::string text = std::string(kHead) + "rooms:\n";
  for (const RoomOutline& room : fitted.rooms) {
    const bool is_rectangle = isRectangle(room);
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
