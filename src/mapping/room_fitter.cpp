#include "sightline/mapping/room_fitter.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "polygon_search.h"
#include "room_search.h"
#include "sightline/mapping/wall_adjustment.h"

namespace sightline::mapping {

namespace {

using geometry::Pose2;

constexpr struct {
  double corridor = 4.0;         // times as long as wide
  double corridor_length = 5.0;  // [m]
  double niche = 1.6;            // area of a room that may be a doorway [m²]
  double passage_width = 0.9;    // of a room made where the path leads over a gap [m]
  double shortest_passage = 0.6;
  double longest_passage = 6.0;
  double doorway = 1.2;     // way between two rooms through one door [m]
  double least_wall = 3.0;  // of all rooms together: less is no building [m]
} kRooms{};

// Number of crossings between rooms that are too far apart for a door.
std::size_t distances(const std::vector<RoomOutline>& rooms,
                      const std::vector<geometry::StampedPose2>& path) {
  const auto crossings = crossingsOf(path, rooms);
  return static_cast<std::size_t>(
      std::count_if(crossings.begin(), crossings.end(), [](const Crossing& crossing) {
        return (crossing.left_map - crossing.entered_map).norm() > kRooms.doorway;
      }));
}

// Leaves out rooms that are no more than the depth of a doorway: the rooms before and behind them
// meet as well without.
void dropNiches(std::vector<RoomOutline>& rooms, const std::vector<geometry::StampedPose2>& path) {
  for (std::size_t r = 0; r < rooms.size();) {
    std::vector<RoomOutline> without = rooms;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(r));
    const bool is_niche =
        rooms[r].area() < kRooms.niche && distances(without, path) <= distances(rooms, path);
    if (is_niche) {
      rooms = std::move(without);
    } else {
      ++r;
    }
  }
}

// In the order in which the path enters them.
void sortByPath(std::vector<RoomOutline>& rooms, const std::vector<geometry::StampedPose2>& path) {
  std::vector<RoomOutline> sorted;
  std::vector<bool> taken(rooms.size(), false);
  for (const geometry::StampedPose2& point : path) {
    for (std::size_t r = 0; r < rooms.size(); ++r) {
      if (taken[r] || !rooms[r].contains(point.pose.translation())) continue;
      taken[r] = true;
      sorted.push_back(rooms[r]);
    }
  }
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    if (!taken[r]) sorted.push_back(rooms[r]);
  }
  rooms = std::move(sorted);
}

void nameRooms(std::vector<RoomOutline>& rooms) {
  int corridors = 0;
  int others = 0;
  for (RoomOutline& room : rooms) {
    const double a = room.side(0).length();
    const double b = room.side(1).length();
    const bool is_corridor = room.sides.size() == 4 && std::max(a, b) > kRooms.corridor_length &&
                             std::max(a, b) > kRooms.corridor * std::min(a, b);
    room.name =
        is_corridor ? fmt::format("corridor_{}", ++corridors) : fmt::format("room_{}", ++others);
  }
}

double shareInside(const std::vector<geometry::StampedPose2>& path,
                   const std::vector<RoomOutline>& rooms) {
  const auto is_inside = [&](const geometry::StampedPose2& point) {
    return std::any_of(rooms.begin(), rooms.end(), [&](const RoomOutline& room) {
      return room.contains(point.pose.translation());
    });
  };
  const auto count = std::count_if(path.begin(), path.end(), is_inside);
  return path.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(path.size());
}

double wallOf(const std::vector<RoomOutline>& rooms) {
  double length = 0.0;
  for (const RoomOutline& room : rooms) {
    for (const auto& spans : room.spans) {
      for (const world::Span& span : spans) length += span.to - span.from;
    }
  }
  return length;
}

// Spans of the walls, and doors.
void findOpenings(const std::vector<KeyScan>& keys, FittedRooms& fitted) {
  const auto evidence = gatherEvidence(keys, fitted.path.keys, fitted.rooms);
  for (std::size_t r = 0; r < fitted.rooms.size(); ++r) {
    RoomOutline& room = fitted.rooms[r];
    for (std::size_t i = 0; i < room.sides.size(); ++i) {
      room.spans[i] = spansOf(evidence[r][i], room.side(i).length());
    }
  }
  FoundDoors found = findDoors(crossingsOf(fitted.poses, fitted.rooms), fitted.rooms, evidence);
  fitted.doors = std::move(found.doors);
  fitted.missing_doors = std::move(found.missing);
}

// A room without walls where the path leads over a gap between two rooms. Returns whether there is
// one more.
bool bridgeGap(const Crossing& crossing, std::vector<RoomOutline>& rooms) {
  const Eigen::Vector2d middle = 0.5 * (crossing.left_map + crossing.entered_map);
  if (std::any_of(rooms.begin(), rooms.end(),
                  [&](const RoomOutline& room) { return room.contains(middle); })) {
    return false;
  }
  const Eigen::Vector2d way = crossing.entered_map - crossing.left_map;
  const double length = way.norm();
  if (length < kRooms.shortest_passage || length > kRooms.longest_passage) return false;
  rooms.push_back(
      rectangleOutline(middle, std::atan2(way.y(), way.x()), {length, kRooms.passage_width}));
  return true;
}

// Rooms about a path whose loops are closed; the path may give way a little to the walls.
//
// @param adjusted  the poses of the scans by those of the key scans
template <class Poses>
void fitAbout(const std::vector<KeyScan>& keys, const Poses& adjusted, const Progress& report,
              FittedRooms& fitted) {
  fitted.rooms = searchRooms(keys, fitted.path.keys);
  describeByPolygons(keys, fitted.path.keys, fitted.rooms);
  report(0.8);
  adjustWalls(keys, fitted.path, fitted.rooms);
  report(0.95);
  fitted.poses = adjusted();
  dropNiches(fitted.rooms, fitted.poses);
  findOpenings(keys, fitted);
  bool has_bridged = false;
  for (const Crossing& crossing : fitted.missing_doors) {
    has_bridged = bridgeGap(crossing, fitted.rooms) || has_bridged;
  }
  sortByPath(fitted.rooms, fitted.poses);
  nameRooms(fitted.rooms);
  findOpenings(keys, fitted);
  if (wallOf(fitted.rooms) < kRooms.least_wall) {
    fitted.rooms.clear();
    fitted.doors.clear();
    fitted.missing_doors.clear();
  }
  fitted.inside = shareInside(fitted.poses, fitted.rooms);
  report(1.0);
}

Progress reportTo(const Progress& progress) {
  return [&progress](double share) {
    if (progress) progress(share);
  };
}

}  // namespace

FittedRooms fitRooms(const Survey& survey, const Progress& progress) {
  FittedRooms fitted;
  const auto& keys = survey.keys();
  const Progress report = reportTo(progress);
  fitted.path = PathAdjuster(keys, [&](double share) { report(0.7 * share); }).adjust();
  if (keys.empty()) return fitted;
  fitAbout(
      keys, [&] { return posesOf(survey.path(), keys, fitted.path.keys); }, report, fitted);
  return fitted;
}

FittedRooms fitRooms(const GridSurvey& survey, const Progress& progress) {
  FittedRooms fitted;
  fitted.path.keys = survey.poses;
  fitted.path.is_exact = true;
  fitAbout(
      survey.keys, [&] { return survey.path; }, reportTo(progress), fitted);
  for (RoomOutline& room : fitted.rooms) {
    for (std::size_t i = 0; i < room.sides.size(); ++i) {
      // A wall in one row of cells, and one that leaves it at either end.
      const double variance = survey.cell * survey.cell / 12.0;
      const double length = std::max(survey.cell, room.side(i).length());
      room.sides[i].covariance += Eigen::Vector2d(variance, 2.0 * variance / (length * length))
                                      .asDiagonal()
                                      .toDenseMatrix();
    }
  }
  return fitted;
}

}  // namespace sightline::mapping
