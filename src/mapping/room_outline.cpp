#include "sightline/mapping/room_outline.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/angle.h"

namespace sightline::mapping {

namespace {

// A side that bends away from its rectangle by less is a side of it [m].
constexpr double kSquare = 0.01;
constexpr double kRight = 1e-6;  // of a right angle [rad]

// The rectangle through the middles of the sides, turned as they are on average.
Rectangle nearestRectangle(const RoomOutline& room) {
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
    SideLine side;
    side.angle = angle;
    side.distance = -half;
    room.sides.push_back(side);
  }
  room.spans.resize(4);
  return room;
}

std::optional<Rectangle> rectangleOf(const RoomOutline& room) {
  if (room.sides.size() != 4) return std::nullopt;
  const Rectangle rectangle = nearestRectangle(room);
  const Eigen::Vector2d half = 0.5 * rectangle.size;
  const Eigen::Vector2d corners[4] = {
      {-half.x(), -half.y()}, {half.x(), -half.y()}, half, {-half.x(), half.y()}};
  for (std::size_t i = 0; i < 4; ++i) {
    if ((rectangle.pose * corners[i] - room.side(i).start).norm() > kSquare) return std::nullopt;
  }
  return rectangle;
}

bool isSquare(const RoomOutline& room) {
  for (std::size_t i = 0; i < room.sides.size(); ++i) {
    const double turn = room.sides[(i + 1) % room.sides.size()].angle - room.sides[i].angle;
    if (std::abs(geometry::wrapAngle(turn - 0.5 * geometry::kPi)) > kRight) return false;
  }
  return room.sides.size() == 4;
}

bool isRoom(const RoomOutline& room) {
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t i = 0; i < room.sides.size(); ++i) corners.push_back(room.side(i).start);
  try {
    world::RoomMap().addPolygon("", corners);
  } catch (const world::InvalidRoomMap&) {
    return false;
  }
  return true;
}

world::WallSigma sigmaOf(const RoomOutline& room, std::size_t i) {
  const auto rectangle = rectangleOf(room);
  const double right = 0.5 * geometry::kPi * (static_cast<double>(i) + 1.0);
  const double left_out =
      rectangle ? geometry::wrapAngle(room.sides[i].angle - rectangle->pose.theta() - right) : 0.0;
  // Whatever stretch of an arc is seen has its own direction.
  const double arc = std::abs(room.sides[i].curvature) * room.side(i).length() / std::sqrt(12.0);
  const Eigen::Matrix2d& covariance = room.sides[i].covariance;
  const double position = std::hypot(std::sqrt(covariance(0, 0)), room.sides[i].bend);
  const double direction = std::hypot(std::sqrt(covariance(1, 1)), left_out, arc);
  const auto within = [](const config::Range& range, double value) {
    return std::clamp(value, range.min, range.max);
  };
  return {within(world::kWallPositionSigmas, position),
          within(world::kWallDirectionSigmas, direction)};
}

RoomOutline outlineOf(const world::Room& room) {
  RoomOutline outline;
  outline.name = room.name;
  for (const world::Wall& wall : room.walls) outline.anchor += wall.segment.start;
  outline.anchor /= static_cast<double>(room.walls.size());
  for (const world::Wall& wall : room.walls) {
    const Eigen::Vector2d normal = wall.segment.leftNormal();
    SideLine side;
    side.angle = std::atan2(normal.y(), normal.x());
    side.distance = normal.dot(wall.segment.midpoint() - outline.anchor);
    if (wall.sigma) {
      side.covariance =
          Eigen::Vector2d(wall.sigma->position, wall.sigma->direction).cwiseAbs2().asDiagonal();
    }
    side.is_seen = !wall.spans.empty();
    outline.sides.push_back(side);
    outline.spans.push_back(wall.spans);
  }
  return outline;
}

RoomOutline operator*(const geometry::Pose2& T, RoomOutline room) {
  room.anchor = T * room.anchor;
  for (SideLine& side : room.sides) side.angle = geometry::wrapAngle(side.angle + T.theta());
  return room;
}

}  // namespace sightline::mapping
