#include "sightline/world/room_map.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace sightline::world {

namespace {

using config::Node;
using geometry::Segment;

// What a building may measure [m]: beyond, squares overflow or vanish.
constexpr config::Range kLengths{0.001, 1e6};
constexpr config::Range kCoordinates{-1e6, 1e6};
// A door may stand this far from the walls it pierces: half the thickest wall between two rooms.
constexpr double kMaxDoorDistance = 0.5;
// Drawn by hand, what lies in a wall may overshoot its corner by this much.
constexpr double kSlack = 0.02;

Eigen::Vector2d pointOf(const Node& node) {
  const auto xy = node.numbers(2, kCoordinates);
  return {xy[0], xy[1]};
}

geometry::Pose2 poseOf(const Node& room) {
  if (!room.has("pose")) return {};
  const auto p = room.at("pose").numbers(3, kCoordinates);
  return {p[0], p[1], p[2]};
}

double signedArea(const std::vector<Eigen::Vector2d>& corners) {
  double twice = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * twice;
}

bool onOppositeSides(const Segment& line, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return line.leftNormal().dot(a - line.start) * line.leftNormal().dot(b - line.start) < 0.0;
}

bool cross(const Segment& a, const Segment& b) {
  return onOppositeSides(a, b.start, b.end) && onOppositeSides(b, a.start, a.end);
}

struct Outline {
  std::vector<Eigen::Vector2d> corners;  // in the room's frame, counter-clockwise
  std::vector<std::string> names;        // of the wall from each corner to the next

  Segment side(std::size_t i) const { return {corners[i], corners[(i + 1) % corners.size()]}; }
};

Outline rectangle(const Node& size) {
  const auto lengths = size.numbers(2, kLengths);
  const double x = 0.5 * lengths[0];
  const double y = 0.5 * lengths[1];
  return {{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, {"south", "east", "north", "west"}};
}

void checkSides(const Node& node, const Outline& outline) {
  for (std::size_t i = 0; i < outline.corners.size(); ++i) {
    const Segment side = outline.side(i);
    if (!(side.length() >= kLengths.min)) node.fail(fmt::format("wall {} has no length", i));
    for (std::size_t j = 0; j < i; ++j) {
      if (cross(side, outline.side(j))) node.fail(fmt::format("walls {} and {} cross", j, i));
    }
  }
}

Outline polygon(const Node& node) {
  Outline outline;
  for (const Node& item : node.items()) {
    outline.names.push_back(std::to_string(outline.corners.size()));
    outline.corners.push_back(pointOf(item));
  }
  if (outline.corners.size() < 3) node.fail("a polygon needs three corners");
  if (!(signedArea(outline.corners) > 0.0)) {
    node.fail("the corners have to run counter-clockwise round an area");
  }
  checkSides(node, outline);
  return outline;
}

Outline outlineOf(const Node& room) {
  if (room.has("size") == room.has("polygon")) {
    room.fail("a room has either the key 'size' or the key 'polygon'");
  }
  return room.has("size") ? rectangle(room.at("size")) : polygon(room.at("polygon"));
}

std::vector<Span> spansOf(const Node& wall, double length) {
  std::vector<Span> spans;
  for (const Node& item : wall.items()) {
    const auto ends = item.numbers(2);
    const Span span{std::max(0.0, ends[0]), std::min(length, ends[1])};
    if (ends[0] < -kSlack || ends[1] > length + kSlack || span.from >= span.to) {
      item.fail(
          fmt::format("[{}, {}] is no stretch of a wall of {:.3f} m", ends[0], ends[1], length));
    }
    if (!spans.empty() && span.from < spans.back().to) item.fail("overlaps the span before it");
    spans.push_back(span);
  }
  return spans;
}

std::string wallNames(const Room& room) {
  std::vector<std::string> names;
  for (const Wall& wall : room.walls) names.push_back(wall.name);
  return fmt::format("its walls are: {}", fmt::join(names, ", "));
}

void readWall(const Node& node, Wall& wall) {
  node.allowOnly({"spans", "open"});
  if (node.has("spans") && node.has("open")) node.fail("either 'spans' or 'open', not both");
  if (node.has("spans")) wall.spans = spansOf(node.at("spans"), wall.segment.length());
  if (node.has("open") && node.at("open").flag()) wall.spans.clear();
}

void readWalls(const Node& node, Room& room) {
  for (const auto& [name, wall_node] : node.entries()) {
    const auto wall = std::find_if(room.walls.begin(), room.walls.end(),
                                   [&key = name](const Wall& w) { return w.name == key; });
    if (wall == room.walls.end()) wall_node.fail("no such wall in this room; " + wallNames(room));
    readWall(wall_node, *wall);
  }
}

void cut(std::vector<Span>& spans, const Span& gap) {
  std::vector<Span> left;
  for (const Span& span : spans) {
    if (span.from < gap.from) left.push_back({span.from, std::min(span.to, gap.from)});
    if (span.to > gap.to) left.push_back({std::max(span.from, gap.to), span.to});
  }
  spans = std::move(left);
}

std::size_t nearestWall(const Room& room, const Eigen::Vector2d& point) {
  const auto nearer = [&](const Wall& a, const Wall& b) {
    return a.segment.distance(point) < b.segment.distance(point);
  };
  const auto wall = std::min_element(room.walls.begin(), room.walls.end(), nearer);
  return static_cast<std::size_t>(wall - room.walls.begin());
}

// Opens the wall that the door stands in and returns its index.
std::size_t pierce(const Node& node, const Door& door, Room& room) {
  const std::size_t index = nearestWall(room, door.centre_map);
  Wall& wall = room.walls[index];
  const double distance = wall.segment.distance(door.centre_map);
  if (distance > kMaxDoorDistance) {
    node.fail(
        fmt::format("joins nothing: {:.2f} m from the nearest wall of '{}'", distance, room.name));
  }
  if (door.width > wall.segment.length() + kSlack) {
    node.at("width").fail(fmt::format("{} m is wider than wall {} of '{}', {:.3f} m", door.width,
                                      wall.name, room.name, wall.segment.length()));
  }
  const double middle = wall.segment.along(door.centre_map);
  cut(wall.spans, {middle - 0.5 * door.width, middle + 0.5 * door.width});
  return index;
}

}  // namespace

bool Room::contains(const Eigen::Vector2d& p) const {
  // Crossings of a ray along +x: works for any simple polygon.
  bool inside = false;
  for (const Wall& wall : walls) {
    const Eigen::Vector2d& a = wall.segment.start;
    const Eigen::Vector2d& b = wall.segment.end;
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

double Room::distance(const Eigen::Vector2d& point_map) const {
  if (contains(point_map)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls) nearest = std::min(nearest, wall.segment.distance(point_map));
  return nearest;
}

RoomMap::RoomMap(const Node& document) {
  document.allowOnly({"rooms", "doors"});
  for (const auto& [name, node] : document.at("rooms").entries()) addRoom(name, node);
  if (rooms_.empty()) document.at("rooms").fail("no rooms");
  if (!document.has("doors")) return;
  for (const Node& door : document.at("doors").items()) addDoor(door);
}

void RoomMap::addRoom(const std::string& name, const Node& node) {
  node.allowOnly({"size", "polygon", "pose", "walls"});
  const Outline outline = outlineOf(node);
  Room room{name, poseOf(node), {}};
  for (std::size_t i = 0; i < outline.corners.size(); ++i) {
    const Segment side = outline.side(i);
    room.walls.push_back({outline.names[i], room.T_map_room * side, {{0.0, side.length()}}});
  }
  if (node.has("walls")) readWalls(node.at("walls"), room);
  rooms_.push_back(std::move(room));
}

std::size_t RoomMap::roomNamed(const Node& name) const {
  const auto room = find(name.text());
  if (!room) name.fail(fmt::format("no room is called '{}'", name.text()));
  return *room;
}

void RoomMap::addDoor(const Node& node) {
  node.allowOnly({"between", "at", "width", "threshold"});
  const auto names = node.at("between").items();
  if (names.size() != 2) node.at("between").fail("a door joins two rooms");
  Door door;
  door.centre_map = pointOf(node.at("at"));
  door.width = node.at("width").number(kLengths);
  if (node.has("threshold")) door.threshold = node.at("threshold").flag();
  for (std::size_t side = 0; side < 2; ++side) {
    door.rooms[side] = roomNamed(names[side]);
    door.walls[side] = pierce(node, door, rooms_[door.rooms[side]]);
  }
  if (door.rooms[0] == door.rooms[1]) node.at("between").fail("joins a room with itself");
  doors_.push_back(door);
}

std::optional<std::size_t> RoomMap::find(const std::string& name) const {
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    if (rooms_[i].name == name) return i;
  }
  return std::nullopt;
}

std::optional<std::size_t> RoomMap::roomAt(const Eigen::Vector2d& point_map,
                                           std::optional<std::size_t> preferred) const {
  if (preferred && rooms_[*preferred].contains(point_map)) return preferred;
  for (std::size_t i = 0; i < rooms_.size(); ++i) {
    if (rooms_[i].contains(point_map)) return i;
  }
  return std::nullopt;
}

std::size_t RoomMap::nearestRoom(const Eigen::Vector2d& point_map) const {
  const auto nearer = [&](const Room& a, const Room& b) {
    return a.distance(point_map) < b.distance(point_map);
  };
  return static_cast<std::size_t>(std::min_element(rooms_.begin(), rooms_.end(), nearer) -
                                  rooms_.begin());
}

const Door* RoomMap::doorBetween(std::size_t a, std::size_t b,
                                 const Eigen::Vector2d& near_map) const {
  const Door* nearest = nullptr;
  for (const Door& door : doors_) {
    const bool joins =
        (door.rooms[0] == a && door.rooms[1] == b) || (door.rooms[0] == b && door.rooms[1] == a);
    if (!joins) continue;
    if (!nearest || (door.centre_map - near_map).norm() < (nearest->centre_map - near_map).norm()) {
      nearest = &door;
    }
  }
  return nearest;
}

}  // namespace sightline::world
