#include "sightline/mapping/room_outline.h"

#include <cmath>

#include "sightline/geometry/angle.h"

namespace sightline::mapping {

namespace {

// Where two sides meet, from the anchor.
Eigen::Vector2d meeting(const SideLine& a, const SideLine& b) {
  const double cross = std::sin(b.angle - a.angle);
  const Eigen::Vector2d na = a.normal();
  const Eigen::Vector2d nb = b.normal();
  return {(a.distance * nb.y() - b.distance * na.y()) / cross,
          (b.distance * na.x() - a.distance * nb.x()) / cross};
}

}  // namespace

geometry::Segment RoomOutline::side(std::size_t i) const {
  const std::size_t n = sides.size();
  return {anchor + meeting(sides[(i + n - 1) % n], sides[i]),
          anchor + meeting(sides[i], sides[(i + 1) % n])};
}

bool RoomOutline::contains(const Eigen::Vector2d& p) const {
  bool inside = false;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const geometry::Segment s = side(i);
    if ((s.start.y() > p.y()) == (s.end.y() > p.y())) continue;
    const double share = (p.y() - s.start.y()) / (s.end.y() - s.start.y());
    if (p.x() < s.start.x() + share * (s.end.x() - s.start.x())) inside = !inside;
  }
  return inside;
}

double RoomOutline::area() const {
  double twice = 0.0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const geometry::Segment s = side(i);
    const Eigen::Vector2d a = s.start - anchor;
    const Eigen::Vector2d b = s.end - anchor;
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * twice;
}

RoomOutline rectangleOutline(const Eigen::Vector2d& middle_map, double turn,
                             const Eigen::Vector2d& size) {
  RoomOutline room;
  room.anchor = middle_map;
  for (int i = 0; i < 4; ++i) {  // south, east, north, west
    const double angle = geometry::wrapAngle(turn + 0.5 * geometry::kPi * (i + 1));
    const double half = 0.5 * (i % 2 == 0 ? size.y() : size.x());
    room.sides.push_back({angle, -half, Eigen::Matrix2d::Zero(), false});
  }
  room.spans.resize(4);
  return room;
}

}  // namespace sightline::mapping
