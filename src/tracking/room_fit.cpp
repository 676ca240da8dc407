#include "sightline/tracking/room_fit.h"

#include <cmath>
#include <limits>

namespace sightline::tracking {

namespace {

// A wall seen from a sensor: everything about it that does not depend on the beam.
struct SeenWall {
  Eigen::Vector2d normal;  // into the room
  Eigen::Vector2d direction;
  double distance;  // of the sensor from the wall, inside
  double foot;      // of its perpendicular, metres from the wall's start
  double length;
  const world::Wall* wall;
};

std::vector<SeenWall> wallsFacing(const world::Room& room, const Eigen::Vector2d& sensor) {
  std::vector<SeenWall> walls;
  for (const world::Wall& wall : room.walls) {
    const Eigen::Vector2d normal = wall.segment.leftNormal();
    const double distance = normal.dot(sensor - wall.segment.start);
    if (distance <= 0.0) continue;
    walls.push_back({normal, wall.segment.direction(), distance, wall.segment.along(sensor),
                     wall.segment.length(), &wall});
  }
  return walls;
}

// The wall that a ray meets first, and where.
struct Meeting {
  const SeenWall* wall = nullptr;
  double range = std::numeric_limits<double>::infinity();
  double along = 0.0;
  double cos_incidence = 0.0;
};

Meeting firstWall(const std::vector<SeenWall>& walls, const Eigen::Vector2d& direction) {
  Meeting first;
  for (const SeenWall& wall : walls) {
    const double approach = -wall.normal.dot(direction);
    if (approach <= 1e-6) continue;
    const double range = wall.distance / approach;
    const double along = wall.foot + range * wall.direction.dot(direction);
    if (range >= first.range || along < 0.0 || along > wall.length) continue;
    first = {&wall, range, along, approach};
  }
  return first;
}

bool isOnSpan(const world::Wall& wall, double along, double margin) {
  for (const world::Span& span : wall.spans) {
    if (along >= span.from + margin && along <= span.to - margin) return true;
  }
  return false;
}

}  // namespace

RoomFit fitToRoom(const scan::Scan& scan, const geometry::Pose2& T_map_sensor,
                  const world::Room& room, double tolerance) {
  const std::vector<SeenWall> walls = wallsFacing(room, T_map_sensor.translation());
  const Eigen::Matrix2d rotation = T_map_sensor.rotation();
  RoomFit fit;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const bool nothing = scan.kinds()[i] == scan::ReturnKind::kNothing;
    if (!scan.isValid(i) && !nothing) continue;
    const Meeting meeting = firstWall(walls, rotation * scan.direction(i));
    if (!meeting.wall || !isOnSpan(*meeting.wall->wall, meeting.along, tolerance)) continue;
    if (nothing && meeting.range > scan.geometry()->rangeMax()) continue;
    const double excess =
        nothing ? tolerance + 1.0 : (scan.ranges()[i] - meeting.range) * meeting.cos_incidence;
    if (excess > tolerance) {
      ++fit.beyond;
    } else if (excess < -tolerance) {
      ++fit.occluded;
    } else {
      ++fit.on_wall;
    }
  }
  return fit;
}

}  // namespace sightline::tracking
