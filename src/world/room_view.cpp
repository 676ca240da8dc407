#include "sightline/world/room_view.h"

#include <algorithm>
#include <limits>

namespace sightline::world {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Numerical limits of a ray.
constexpr struct {
  // A ray nearer than this to running along a wall does not meet it.
  double least_approach = 1e-6;
  // A ray passes no more doors than this: what is seen through more is a few beams wide.
  int most_doors = 4;
} kRays;

double clearance(const Span& span, double along) {
  return std::min(along - span.from, span.to - along);
}

}  // namespace

FacingSide::FacingSide(const geometry::Segment& segment, const Eigen::Vector2d& eye)
    : normal_(segment.leftNormal()),
      direction_(segment.direction()),
      distance_(normal_.dot(eye - segment.start)),
      foot_(direction_.dot(eye - segment.start)),
      length_(segment.length()) {}

std::optional<FacingSide::Meeting> FacingSide::meet(const Eigen::Vector2d& direction) const {
  const double approach = -normal_.dot(direction);
  if (distance_ <= 0.0 || approach <= kRays.least_approach) return std::nullopt;
  // Most rays pass by: that is seen before anything is divided.
  const double along_by_approach = foot_ * approach + distance_ * direction_.dot(direction);
  if (along_by_approach < 0.0 || along_by_approach > length_ * approach) return std::nullopt;
  const double range = distance_ / approach;
  const double along = foot_ + range * direction_.dot(direction);
  return Meeting{range, along, std::min(1.0, approach)};
}

RoomView::RoomView(const RoomMap& map, std::size_t room, const Eigen::Vector2d& eye_map,
                   Doors doors)
    : map_(map), room_(room), eye_(eye_map), doors_(doors) {
  const std::vector<Wall>& walls = map.rooms()[room].walls;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const FacingSide side(walls[i].segment, eye_map);
    if (side.distance() <= 0.0) continue;
    sides_.push_back(side);
    side_walls_.push_back(i);
  }
  if (doors == Doors::kOpen) doorway_ = doorwayOf();
}

std::optional<Sighting> RoomView::look(const Eigen::Vector2d& direction_map) const {
  auto ray = start(direction_map);
  if (!ray) return std::nullopt;
  std::optional<Sighting> sighting = first(*ray);
  if (doors_ == Doors::kIgnored) return sighting;
  for (int doors = 0; sighting && !sighting->is_solid && doors < kRays.most_doors; ++doors) {
    ray = through(*ray, *sighting);
    if (!ray) break;
    sighting = first(*ray);
  }
  return sighting;
}

// The ray in the first room that it comes into; from a doorway that may be the room behind.
std::optional<RoomView::Ray> RoomView::start(const Eigen::Vector2d& direction) const {
  const Ray ray{direction, room_, 0.0, kInfinity};
  if (!doorway_) return ray;
  for (const std::size_t side : {0U, 1U}) {
    Ray inside = ray;
    if (enter(*doorway_, side, inside)) return inside;
  }
  return std::nullopt;
}

// The nearest wall of the room that the ray is in, beyond the place where it came in.
std::optional<Sighting> RoomView::first(const Ray& ray) const {
  std::optional<FacingSide::Meeting> nearest;
  std::size_t nearest_wall = 0;
  const auto consider = [&](const FacingSide& side, std::size_t wall) {
    const auto meeting = side.meet(ray.direction);
    if (!meeting || meeting->range < ray.range) return;
    if (nearest && meeting->range >= nearest->range) return;
    nearest = meeting;
    nearest_wall = wall;
  };
  if (ray.room == room_) {
    for (std::size_t i = 0; i < sides_.size(); ++i) consider(sides_[i], side_walls_[i]);
  } else {
    const std::vector<Wall>& walls = map_.rooms()[ray.room].walls;
    for (std::size_t i = 0; i < walls.size(); ++i) consider({walls[i].segment, eye_}, i);
  }
  if (!nearest) return std::nullopt;
  Sighting sighting{
      {ray.room, nearest_wall}, nearest->range, nearest->along, nearest->cos_incidence};
  judge(sighting, ray.margin);
  return sighting;
}

void RoomView::judge(Sighting& sighting, double margin) const {
  sighting.margin = margin;
  for (const Span& span : map_.wall(sighting.wall).spans) {
    const double clear = clearance(span, sighting.along);
    if (clear < 0.0) continue;
    sighting.is_solid = true;
    sighting.margin = std::min(margin, clear);
  }
}

// The ray on the other side of the door that it meets in a wall, where there is one.
std::optional<RoomView::Ray> RoomView::through(const Ray& ray, const Sighting& sighting) const {
  for (const Door& door : map_.doors()) {
    for (const std::size_t side : {0U, 1U}) {
      if (door.rooms[side] != sighting.wall.room || door.walls[side] != sighting.wall.wall)
        continue;
      const double clear = clearance(openingOf(door, map_.wall(sighting.wall)), sighting.along);
      if (clear < 0.0) continue;
      Ray next = ray;
      next.range = sighting.range;
      next.margin = std::min(ray.margin, clear);
      if (enter(door, 1 - side, next)) return next;
    }
  }
  return std::nullopt;
}

// Takes a ray into the room on one side of a door, from behind the wall there; false where it ends
// at a jamb.
bool RoomView::enter(const Door& door, std::size_t side, Ray& ray) const {
  const Wall& wall = map_.rooms()[door.rooms[side]].walls[door.walls[side]];
  ray.room = door.rooms[side];
  // Turned round, the wall faces the ray.
  const FacingSide behind({wall.segment.end, wall.segment.start}, eye_);
  if (behind.distance() <= 0.0) return true;  // the eye is past this wall already
  const auto meeting = behind.meet(ray.direction);
  if (!meeting) return false;
  const double along = wall.segment.length() - meeting->along;
  const double clear = clearance(openingOf(door, wall), along);
  ray.range = std::max(ray.range, meeting->range);
  ray.margin = std::min(ray.margin, clear);
  return clear >= 0.0;
}

// The door that the eye stands in, past the wall of its room, if it does.
const Door* RoomView::doorwayOf() const {
  for (const Door& door : map_.doors()) {
    for (const std::size_t side : {0U, 1U}) {
      if (door.rooms[side] != room_) continue;
      const Wall& wall = map_.rooms()[room_].walls[door.walls[side]];
      const bool is_past = wall.segment.leftNormal().dot(eye_ - wall.segment.start) <= 0.0;
      if (is_past && clearance(openingOf(door, wall), wall.segment.along(eye_)) >= 0.0) {
        return &door;
      }
    }
  }
  return nullptr;
}

}  // namespace sightline::world
