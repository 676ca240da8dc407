#include "sightline/mapping/room_merge.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sightline/config/error.h"
#include "sightline/world/room_map_file.h"

namespace sightline::mapping {

namespace {

using geometry::Pose2;

constexpr struct {
  double lattice = 0.1;  // of places that are asked which room they are in [m]
  double same = 0.5;     // share of a room that is in rooms that are there
  double apart = 0.12;   // between a room that is cut and the one that it is cut by [m]
  double least_overlap = 0.05;
  double least_area = 1.6;     // of what is left [m²]
  double least_size = 0.8;     // [m]
  double shortest_span = 0.2;  // [m]
  double same_door = 0.8;      // doors between the same rooms that are one [m]
} kMerge{};

void moveTo(const Pose2& T, FittedRooms& fitted) {
  for (RoomOutline& room : fitted.rooms) room = T * room;
  for (FittedDoor& door : fitted.doors) door.centre_map = T * door.centre_map;
  for (Crossing& crossing : fitted.missing_doors) {
    crossing.left_map = T * crossing.left_map;
    crossing.entered_map = T * crossing.entered_map;
  }
  for (auto& pose : fitted.poses) pose.pose = T * pose.pose;
  for (Pose2& pose : fitted.path.keys) pose = T * pose;
}

// Share of a room that rooms of a map hold.
double shareIn(const std::vector<RoomOutline>& known, const RoomOutline& room) {
  Eigen::Vector2d low = room.side(0).start;
  Eigen::Vector2d high = low;
  for (std::size_t i = 0; i < room.sides.size(); ++i) {
    low = low.cwiseMin(room.side(i).start);
    high = high.cwiseMax(room.side(i).start);
  }
  double inside = 0.0;
  double all = 0.0;
  for (double x = low.x(); x < high.x(); x += kMerge.lattice) {
    for (double y = low.y(); y < high.y(); y += kMerge.lattice) {
      if (!room.contains({x, y})) continue;
      all += 1.0;
      inside += std::any_of(known.begin(), known.end(),
                            [&](const RoomOutline& other) {
                              return other.contains({x, y});
                            })
                    ? 1.0
                    : 0.0;
    }
  }
  return inside / std::max(1.0, all);
}

// Distance inwards from a side of a room to the far end of another room.
double depthOf(const RoomOutline& other, const SideLine& side, const Eigen::Vector2d& anchor) {
  double deepest = -1e9;
  for (std::size_t i = 0; i < other.sides.size(); ++i) {
    deepest = std::max(deepest, side.normal().dot(other.side(i).start - anchor) - side.distance);
  }
  return deepest;
}

// The spans of a side that begins later by so much, and is so long.
std::vector<world::Span> cutSpans(const std::vector<world::Span>& spans, double later,
                                  double length) {
  std::vector<world::Span> left;
  for (const world::Span& span : spans) {
    const world::Span cut{std::max(0.0, span.from - later), std::min(length, span.to - later)};
    if (cut.to - cut.from >= kMerge.shortest_span) left.push_back(cut);
  }
  return left;
}

// The room without the part that another room has, its sides being moved in as little as is enough;
// nothing where too little is left.
std::optional<RoomOutline> without(const RoomOutline& room, const RoomOutline& other) {
  if (shareIn({other}, room) < kMerge.least_overlap) return room;
  std::optional<RoomOutline> best;
  for (std::size_t i = 0; i < room.sides.size(); ++i) {
    RoomOutline cut = room;
    const std::size_t next = (i + 1) % room.sides.size();
    const std::size_t before = (i + room.sides.size() - 1) % room.sides.size();
    cut.sides[i].distance += depthOf(other, room.sides[i], room.anchor) + kMerge.apart;
    cut.sides[i].is_seen = false;
    const double width = cut.side(next).length();
    cut.spans[i].clear();
    cut.spans[next] = cutSpans(room.spans[next], room.side(next).length() - width, width);
    cut.spans[before] = cutSpans(room.spans[before], 0.0, cut.side(before).length());
    const bool turned = cut.side(i).direction().dot(room.side(i).direction()) < 0.0 ||
                        cut.area() < kMerge.least_area || width < kMerge.least_size ||
                        cut.area() > room.area();
    if (!turned && (!best || cut.area() > best->area())) best = cut;
  }
  return best;
}

// Rooms that the map lacks, and the parts of rooms that it lacks.
std::vector<RoomOutline> newRooms(const std::vector<RoomOutline>& known,
                                  const std::vector<RoomOutline>& found) {
  std::vector<RoomOutline> rooms;
  for (const RoomOutline& room : found) {
    std::optional<RoomOutline> left = room;
    if (room.sides.size() == 4) {
      for (const RoomOutline& other : known) {
        if (left) left = without(*left, other);
      }
    } else if (shareIn(known, room) > kMerge.same) {
      left.reset();
    }
    if (left) rooms.push_back(*left);
  }
  return rooms;
}

void giveNames(const world::RoomMap& map, std::vector<RoomOutline>& rooms) {
  std::vector<std::string> taken;
  for (const world::Room& room : map.rooms()) taken.push_back(room.name);
  for (RoomOutline& room : rooms) {
    const std::string kind = room.name.substr(0, room.name.find('_'));
    int number = 1;
    const auto name = [&] { return fmt::format("{}_{}", kind, number); };
    while (std::count(taken.begin(), taken.end(), name()) > 0) ++number;
    room.name = name();
    taken.push_back(room.name);
  }
}

double rounded(double value, double unit) {
  return std::round(value / unit) * unit;
}

Eigen::Vector2d millimetres(const Eigen::Vector2d& p) {
  return {rounded(p.x(), 1e-3), rounded(p.y(), 1e-3)};
}

std::size_t addOutline(const RoomOutline& room, world::RoomMap& map) {
  if (const auto rectangle = rectangleOf(room)) {
    return map.addRectangle(
        room.name, millimetres(rectangle->size),
        {millimetres(rectangle->pose.translation()), rounded(rectangle->pose.theta(), 1e-5)});
  }
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i < room.sides.size(); ++i) {
    corners.push_back(millimetres(room.side(i).start));
  }
  return map.addPolygon(room.name, corners);
}

void add(const RoomOutline& room, world::RoomMap& map) {
  const std::size_t index = addOutline(room, map);
  for (std::size_t i = 0; i < room.sides.size(); ++i) {
    const double length = map.wall({index, i}).segment.length();
    std::vector<world::Span> spans;
    for (const world::Span& span : room.spans[i]) {
      const double to = std::min(rounded(span.to, 0.01), length);
      if (span.from < to) spans.push_back({rounded(span.from, 0.01), to});
    }
    map.setSpans({index, i}, spans);
    if (!room.sides[i].is_seen) continue;
    const world::WallSigma sigma = sigmaOf(room, i);
    map.setSigma({index, i}, {rounded(sigma.position, 1e-4), rounded(sigma.direction, 1e-5)});
  }
}

bool hasDoor(const world::RoomMap& map, const FittedDoor& door) {
  const world::Door* near = map.doorBetween(door.rooms[0], door.rooms[1], door.centre_map);
  return near && (near->centre_map - door.centre_map).norm() < kMerge.same_door;
}

// Doors that are missing; what a map will not have as a door is one that is still missing.
std::size_t addDoors(const FittedRooms& fitted, world::RoomMap& map) {
  std::size_t added = 0;
  for (const FittedDoor& door : fitted.doors) {
    if (hasDoor(map, door)) continue;
    try {
      map.addDoor(door.rooms[0], door.rooms[1], millimetres(door.centre_map),
                  rounded(door.width, 0.01));
      ++added;
    } catch (const world::InvalidRoomMap&) {
      // Between walls that people have drawn elsewhere.
    }
  }
  return added;
}

RoomAlignment requireAlignment(const std::string& path, const FittedRooms& fitted,
                               const RoomLayout& known) {
  RoomLayout found{fitted.rooms, {}};
  for (const FittedDoor& door : fitted.doors) found.doors.push_back(door.centre_map);
  const auto alignment = alignRooms(found, known);
  if (!alignment) {
    throw config::Error(path, 0, "rooms", "they do not fit: they have no corner to compare");
  }
  if (alignment->isSure()) return *alignment;
  throw config::Error(
      path, 0, "rooms",
      fmt::format(
          "the recording does not fit into them for sure: at best {:.1f} m of wall agree and "
          "{:.1f} m contradict, and elsewhere {:.1f} m speak for it. Record a part of them "
          "with two rooms or more as well",
          alignment->agreeing, alignment->contradicted, std::max(0.0, alignment->rival)));
}

}  // namespace

MergedRooms mergeRooms(const world::RoomMap& map, const std::string& path,
                       const std::vector<KeyScan>& keys, FittedRooms fitted) {
  RoomLayout known;
  for (const world::Room& room : map.rooms()) known.rooms.push_back(outlineOf(room));
  for (const world::Door& door : map.doors()) known.doors.push_back(door.centre_map);
  MergedRooms merged{map, {}, requireAlignment(path, fitted, known), 0};
  std::vector<RoomOutline>& rooms = known.rooms;
  moveTo(merged.alignment.T_known_found, fitted);
  auto added = newRooms(rooms, fitted.rooms);
  giveNames(map, added);
  for (const RoomOutline& room : added) add(room, merged.map);
  rooms.insert(rooms.end(), added.begin(), added.end());
  const auto evidence = gatherEvidence(keys, fitted.path.keys, rooms);
  const auto found = findDoors(crossingsOf(fitted.poses, rooms), rooms, evidence);
  fitted.rooms = rooms;
  fitted.doors = found.doors;
  fitted.missing_doors = found.missing;
  merged.doors = addDoors(fitted, merged.map);
  merged.fitted = std::move(fitted);
  return merged;
}

std::string mergedText(const MergedRooms& merged) {
  return "# Rooms, to which those of another recording were added. Lengths in metres, angles in "
         "radians.\n" +
         world::toYaml(merged.map);
}

}  // namespace sightline::mapping
