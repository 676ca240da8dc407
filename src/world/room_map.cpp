#include "sightline/world/room_map.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace sightline::world {

namespace {

using geometry::Segment;

// Inaccuracy that a drawing may have: chosen by what people draw, not measured.
constexpr struct {
  // A door may stand this far from the walls it pierces: half the thickest wall between two rooms.
  double max_door_distance = 0.5;
  // Drawn by hand, what lies in a wall may overshoot its corner by this much.
  double slack = 0.02;
} kDrawing;

void requireWithin(const config::Range& range, double value, const std::string& key) {
  if (!range.contains(value)) {
    throw InvalidRoomMap(key, fmt::format("{} is outside {}", value, range.text()));
  }
}

void requireCoordinates(const Eigen::Vector2d& point, const std::string& key) {
  requireWithin(kBuildingCoordinates, point.x(), key);
  requireWithin(kBuildingCoordinates, point.y(), key);
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

Segment sideOf(const std::vector<Eigen::Vector2d>& corners, std::size_t i) {
  return {corners[i], corners[(i + 1) % corners.size()]};
}

void requireSides(const std::vector<Eigen::Vector2d>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Segment side = sideOf(corners, i);
    if (!(side.length() >= kBuildingLengths.min)) {
      throw InvalidRoomMap("polygon", fmt::format("wall {} has no length", i));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (cross(side, sideOf(corners, j))) {
        throw InvalidRoomMap("polygon", fmt::format("walls {} and {} cross", j, i));
      }
    }
  }
}

void requireOutline(const std::vector<Eigen::Vector2d>& corners) {
  for (const Eigen::Vector2d& corner : corners) requireCoordinates(corner, "polygon");
  if (corners.size() < 3) throw InvalidRoomMap("polygon", "a polygon needs three corners");
  if (!(signedArea(corners) > 0.0)) {
    throw InvalidRoomMap("polygon", "the corners have to run counter-clockwise round an area");
  }
  requireSides(corners);
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

}  // namespace

Span openingOf(const Door& door, const Wall& wall) {
  const double middle = wall.segment.along(door.centre_map);
  return {middle - 0.5 * door.width, middle + 0.5 * door.width};
}

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

std::size_t RoomMap::add(Room room, const std::vector<std::string>& wall_names) {
  if (find(room.name)) throw InvalidRoomMap("name", fmt::format("'{}' is taken", room.name));
  requireCoordinates(room.T_map_room.translation(), "pose");
  requireWithin(kBuildingCoordinates, room.T_map_room.theta(), "pose");
  for (std::size_t i = 0; i < room.corners.size(); ++i) {
    const Segment side = room.T_map_room * sideOf(room.corners, i);
    room.walls.push_back({wall_names[i], side, {{0.0, side.length()}}, {}});
  }
  rooms_.push_back(std::move(room));
  return rooms_.size() - 1;
}

std::size_t RoomMap::addRectangle(const std::string& name, const Eigen::Vector2d& size,
                                  const geometry::Pose2& T_map_room) {
  requireWithin(kBuildingLengths, size.x(), "size");
  requireWithin(kBuildingLengths, size.y(), "size");
  const double x = 0.5 * size.x();
  const double y = 0.5 * size.y();
  return add({name, T_map_room, {}, {{-x, -y}, {x, -y}, {x, y}, {-x, y}}, true},
             {"south", "east", "north", "west"});
}

std::size_t RoomMap::addPolygon(const std::string& name,
                                const std::vector<Eigen::Vector2d>& corners_room,
                                const geometry::Pose2& T_map_room) {
  requireOutline(corners_room);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < corners_room.size(); ++i) names.push_back(std::to_string(i));
  return add({name, T_map_room, {}, corners_room, false}, names);
}

Wall& RoomMap::wallAt(const WallIndex& index) {
  if (index.room >= rooms_.size() || index.wall >= rooms_[index.room].walls.size()) {
    throw InvalidRoomMap("", "no such wall");
  }
  return rooms_[index.room].walls[index.wall];
}

void RoomMap::setSigma(const WallIndex& index, const WallSigma& sigma) {
  requireWithin(kWallPositionSigmas, sigma.position, "0");
  requireWithin(kWallDirectionSigmas, sigma.direction, "1");
  wallAt(index).sigma = sigma;
}

void RoomMap::setSpans(const WallIndex& index, const std::vector<Span>& spans) {
  Wall& wall = wallAt(index);
  const double length = wall.segment.length();
  std::vector<Span> inside;
  for (const Span& span : spans) {
    const Span kept{std::max(0.0, span.from), std::min(length, span.to)};
    const std::string key = std::to_string(inside.size());
    const bool fits = span.from >= -kDrawing.slack && span.to <= length + kDrawing.slack;
    if (!fits || !(kept.from < kept.to)) {
      throw InvalidRoomMap(key, fmt::format("[{}, {}] is no stretch of a wall of {:.3f} m",
                                            span.from, span.to, length));
    }
    if (!inside.empty() && kept.from < inside.back().to) {
      throw InvalidRoomMap(key, "overlaps the span before it");
    }
    inside.push_back(kept);
  }
  wall.spans = std::move(inside);
}

void RoomMap::addDoor(std::size_t room, std::size_t other, const Eigen::Vector2d& centre_map,
                      double width, bool threshold) {
  if (std::max(room, other) >= rooms_.size()) throw InvalidRoomMap("between", "no such room");
  requireCoordinates(centre_map, "at");
  requireWithin(kBuildingLengths, width, "width");
  Door door{{room, other}, {0, 0}, centre_map, width, threshold};
  for (const std::size_t side : {0U, 1U}) door.walls[side] = pierce(door, door.rooms[side]);
  if (room == other) throw InvalidRoomMap("between", "joins a room with itself");
  for (const std::size_t side : {0U, 1U}) {
    Wall& wall = rooms_[door.rooms[side]].walls[door.walls[side]];
    cut(wall.spans, openingOf(door, wall));
  }
  doors_.push_back(door);
}

// The wall of a room that a door opens.
std::size_t RoomMap::pierce(const Door& door, std::size_t index) const {
  const Room& room = rooms_[index];
  const std::size_t nearest = nearestWall(room, door.centre_map);
  const Segment& wall = room.walls[nearest].segment;
  const double distance = wall.distance(door.centre_map);
  if (distance > kDrawing.max_door_distance) {
    throw InvalidRoomMap("", fmt::format("joins nothing: {:.2f} m from the nearest wall of '{}'",
                                         distance, room.name));
  }
  if (door.width > wall.length() + kDrawing.slack) {
    throw InvalidRoomMap("width",
                         fmt::format("{} m is wider than wall {} of '{}', {:.3f} m", door.width,
                                     room.walls[nearest].name, room.name, wall.length()));
  }
  return nearest;
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
