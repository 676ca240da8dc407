#include "sightline/mapping/door_finder.h"

#include <algorithm>
#include <cmath>

namespace sightline::mapping {

namespace {

constexpr struct {
  double thickest = 0.9;   // wall that a door pierces: it is half a metre from either side [m]
  double same = 0.6;       // crossings this near go through one door [m]
  double narrowest = 0.5;  // that a robot passes [m]
  double usual = 0.8;      // where no gap was seen [m]
  double least_gap = 0.6;  // of a door that was not crossed [m]
  double most_gap = 1.4;
  int least_passes = 6;  // rays through each bin of it
  double passes_per_hit = 6.0;
  std::int64_t pause = 60'000'000'000;  // after which the path is another one [ns]
  double jamb_sigma = 0.005;            // of the edge of a gap, beside the bin that it lies in [m]
  double across_sigma = 0.003;  // of a door in its wall, beside that of the wall: frames [m]
} kDoors{};

struct Stretch {
  double from = 0.0;
  double to = 0.0;
  double width() const { return to - from; }
};

// The gap in a side about a place along it.
Stretch gapAt(const SideEvidence& evidence, double along, double length) {
  const auto middle = static_cast<long>(evidence.binAt(along));
  long from = middle;
  long to = middle;
  const auto is_gap = [&](long i) {
    return i >= 0 && i < static_cast<long>(evidence.bins()) &&
           !evidence.isWall(static_cast<std::size_t>(i));
  };
  while (is_gap(from - 1)) --from;
  while (is_gap(to + 1)) ++to;
  // A bin that is wall in part counts as wall: the edge is half a bin further on average.
  return {std::max(0.0, (static_cast<double>(from) - 0.5) * SideEvidence::kBin),
          std::min(length, (static_cast<double>(to) + 1.5) * SideEvidence::kBin)};
}

// Along the wall by the bins in which the edges of the gap lie, across it by both sides.
Eigen::Matrix2d covarianceOf(const SideLine& here, const SideLine& there) {
  const double edge =
      SideEvidence::kBin * SideEvidence::kBin / 12.0 + kDoors.jamb_sigma * kDoors.jamb_sigma;
  const double walls = 0.25 * (here.covariance(0, 0) + there.covariance(0, 0));
  const Eigen::Vector2d variances(walls + kDoors.across_sigma * kDoors.across_sigma, 0.5 * edge);
  Eigen::Matrix2d axes;
  axes << here.normal(), Eigen::Vector2d(-here.normal().y(), here.normal().x());
  return axes * variances.asDiagonal() * axes.transpose();
}

std::size_t nearestSide(const RoomOutline& room, const Eigen::Vector2d& place,
                        const Eigen::Vector2d& outwards) {
  std::size_t best = 0;
  double least = 1e9;
  for (std::size_t i = 0; i < room.sides.size(); ++i) {
    const geometry::Segment side = room.side(i);
    const double against = 1.0 + side.leftNormal().dot(outwards);  // 0 where it is passed squarely
    const double distance = side.distance(place) + 0.5 * against;
    if (distance < least) best = i;
    least = std::min(least, distance);
  }
  return best;
}

// A door through a side of each of two rooms about a place; nothing where they lie too far apart.
std::optional<FittedDoor> doorAt(const std::vector<RoomOutline>& rooms,
                                 const std::vector<std::vector<SideEvidence>>& evidence,
                                 const std::size_t (&of)[2], const std::size_t (&sides)[2],
                                 const Eigen::Vector2d& place) {
  const geometry::Segment here = rooms[of[0]].side(sides[0]);
  const geometry::Segment there = rooms[of[1]].side(sides[1]);
  const Eigen::Vector2d axis = here.direction();
  const auto alongHere = [&](const Eigen::Vector2d& p) { return axis.dot(p - here.start); };
  Stretch gap = gapAt(evidence[of[0]][sides[0]], here.along(place), here.length());
  const Stretch other = gapAt(evidence[of[1]][sides[1]], there.along(place), there.length());
  const double a = alongHere(there.start + other.from * there.direction());
  const double b = alongHere(there.start + other.to * there.direction());
  gap = {std::max({gap.from, std::min(a, b), 0.0}),
         std::min({gap.to, std::max(a, b), here.length()})};
  const double at = std::clamp(alongHere(place), 0.0, here.length());
  if (gap.width() < kDoors.narrowest || at < gap.from || at > gap.to) {
    gap = {std::max(0.0, at - 0.5 * kDoors.usual),
           std::min(here.length(), at + 0.5 * kDoors.usual)};
  }
  FittedDoor door{{of[0], of[1]}, {sides[0], sides[1]}, {}, 0.0, {}, false};
  door.width = std::min({gap.width(), here.length(), there.length()});
  const Eigen::Vector2d on_here = here.start + 0.5 * (gap.from + gap.to) * axis;
  const double along_there = std::clamp(there.along(on_here), 0.0, there.length());
  const Eigen::Vector2d on_there = there.start + along_there * there.direction();
  if ((on_here - on_there).norm() > kDoors.thickest) return std::nullopt;
  door.centre_map = 0.5 * (on_here + on_there);
  door.covariance = covarianceOf(rooms[of[0]].sides[sides[0]], rooms[of[1]].sides[sides[1]]);
  return door;
}

bool isSame(const FittedDoor& a, const FittedDoor& b) {
  const bool joins = (a.rooms[0] == b.rooms[0] && a.rooms[1] == b.rooms[1]) ||
                     (a.rooms[0] == b.rooms[1] && a.rooms[1] == b.rooms[0]);
  return joins &&
         (a.centre_map - b.centre_map).norm() < std::max(kDoors.same, 0.5 * (a.width + b.width));
}

bool isKnown(const std::vector<FittedDoor>& doors, const FittedDoor& door) {
  return std::any_of(doors.begin(), doors.end(),
                     [&](const FittedDoor& other) { return isSame(door, other); });
}

// Gaps between two walls of a side through which many rays went, and next to none ended.
std::vector<Stretch> seenGaps(const SideEvidence& evidence) {
  std::vector<Stretch> gaps;
  std::optional<std::size_t> wall;
  bool all_open = true;
  for (std::size_t i = 0; i < evidence.bins(); ++i) {
    if (!evidence.isWall(i)) {
      all_open = all_open && evidence.passes[i] >= kDoors.least_passes &&
                 evidence.passes[i] > kDoors.passes_per_hit * evidence.hits[i];
      continue;
    }
    if (wall && i > *wall + 1 && all_open) {
      gaps.push_back({static_cast<double>(*wall + 1) * SideEvidence::kBin,
                      static_cast<double>(i) * SideEvidence::kBin});
    }
    wall = i;
    all_open = true;
  }
  return gaps;
}

// Whether a side has such a gap about a place.
bool hasGap(const SideEvidence& evidence, double along) {
  const auto gaps = seenGaps(evidence);
  return std::any_of(gaps.begin(), gaps.end(), [&](const Stretch& gap) {
    return gap.from < along && along < gap.to && gap.width() < kDoors.most_gap;
  });
}

// The other room just behind a place on a side, and its side there.
std::optional<std::pair<std::size_t, std::size_t>> behind(const std::vector<RoomOutline>& rooms,
                                                          std::size_t room,
                                                          const Eigen::Vector2d& place,
                                                          const Eigen::Vector2d& outwards) {
  for (double far = 0.1; far < kDoors.thickest; far += 0.1) {
    for (std::size_t r = 0; r < rooms.size(); ++r) {
      if (r == room || !rooms[r].contains(place + far * outwards)) continue;
      return std::make_pair(r, nearestSide(rooms[r], place, -outwards));
    }
  }
  return std::nullopt;
}

void addSeenDoors(const std::vector<RoomOutline>& rooms,
                  const std::vector<std::vector<SideEvidence>>& evidence, FoundDoors& found) {
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    for (std::size_t i = 0; i < rooms[r].sides.size(); ++i) {
      const geometry::Segment side = rooms[r].side(i);
      for (const Stretch& gap : seenGaps(evidence[r][i])) {
        if (gap.width() < kDoors.least_gap || gap.width() > kDoors.most_gap) continue;
        const Eigen::Vector2d place = side.start + 0.5 * (gap.from + gap.to) * side.direction();
        const auto next = behind(rooms, r, place, -side.leftNormal());
        if (!next) continue;
        const geometry::Segment there = rooms[next->first].side(next->second);
        if (there.distance(place) > kDoors.thickest) continue;
        if (!hasGap(evidence[next->first][next->second], there.along(place))) continue;
        const auto door = doorAt(rooms, evidence, {r, next->first}, {i, next->second}, place);
        if (door && door->width >= kDoors.least_gap && !isKnown(found.doors, *door)) {
          found.doors.push_back(*door);
        }
      }
    }
  }
}

}  // namespace

std::vector<Crossing> crossingsOf(const std::vector<geometry::StampedPose2>& path,
                                  const std::vector<RoomOutline>& rooms) {
  std::vector<Crossing> crossings;
  std::optional<std::size_t> room;
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  std::int64_t before = 0;
  for (const geometry::StampedPose2& point : path) {
    if (point.stamp - before > kDoors.pause) room.reset();
    before = point.stamp;
    const Eigen::Vector2d here = point.pose.translation();
    if (room && rooms[*room].contains(here)) {
      last = here;
      continue;
    }
    for (std::size_t r = 0; r < rooms.size(); ++r) {
      if (!rooms[r].contains(here)) continue;
      if (room) crossings.push_back({{*room, r}, last, here});
      room = r;
      last = here;
      break;
    }
  }
  return crossings;
}

FoundDoors findDoors(const std::vector<Crossing>& crossings, const std::vector<RoomOutline>& rooms,
                     const std::vector<std::vector<SideEvidence>>& evidence) {
  FoundDoors found;
  for (const Crossing& crossing : crossings) {
    const Eigen::Vector2d step = crossing.entered_map - crossing.left_map;
    const Eigen::Vector2d ahead = step.normalized();
    const Eigen::Vector2d place = 0.5 * (crossing.left_map + crossing.entered_map);
    const std::size_t sides[2] = {nearestSide(rooms[crossing.rooms[0]], place, ahead),
                                  nearestSide(rooms[crossing.rooms[1]], place, -ahead)};
    auto door = doorAt(rooms, evidence, crossing.rooms, sides, place);
    if (!door) {
      found.missing.push_back(crossing);
    } else if (door->was_crossed = true; !isKnown(found.doors, *door)) {
      found.doors.push_back(*door);
    }
  }
  addSeenDoors(rooms, evidence, found);
  return found;
}

}  // namespace sightline::mapping
