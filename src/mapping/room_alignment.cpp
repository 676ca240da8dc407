#include "sightline/mapping/room_alignment.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "sightline/geometry/angle.h"

namespace sightline::mapping {

namespace {

using geometry::Pose2;
using geometry::Segment;

constexpr struct {
  double near = 0.15;        // of walls that agree [m]
  double parallel = 0.996;   // least cosine between them: 5°
  double inside = 0.35;      // of a room, so far from its sides, a wall contradicts it [m]
  double step = 0.25;        // between places of a wall that are asked [m]
  double door = 0.25;        // from a wall that a door would be in [m]
  double jamb = 0.2;         // of wall on either side of its middle [m]
  double door_price = 3.0;   // of a door where the other has wall [m]
  double least = 4.0;        // of wall that has to agree [m]
  double least_share = 0.7;  // of what agrees or contradicts
  double most_rival = 0.85;  // of the score
  double same = 0.5;         // places this near are one [m, and rad as below]
  double same_turn = 0.1;
  double corner = 0.07;      // by which corners may differ [rad]
  std::size_t refined = 40;  // best places that are refined
  int rounds = 3;
} kAlign{};

struct Corner {
  Eigen::Vector2d place;
  double angle;  // of the normal of the side that begins here
  double turn;   // from the side that ends here
};

struct Building {
  std::vector<RoomOutline> rooms;
  std::vector<Eigen::Vector2d> doors;
  std::vector<Segment> pieces;  // stretches of wall, the inside of their room on the left
  std::vector<Corner> corners;

  explicit Building(const RoomLayout& layout) : rooms(layout.rooms), doors(layout.doors) {
    for (const RoomOutline& room : rooms) add(room);
  }

  void add(const RoomOutline& room) {
    const std::size_t n = room.sides.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Segment side = room.side(i);
      for (const world::Span& span : room.spans[i]) {
        pieces.push_back(
            {side.start + span.from * side.direction(), side.start + span.to * side.direction()});
      }
      const std::size_t before = (i + n - 1) % n;
      if (room.spans[i].empty() || room.spans[before].empty()) continue;
      corners.push_back({side.start, room.sides[i].angle,
                         geometry::wrapAngle(room.sides[i].angle - room.sides[before].angle)});
    }
  }

  // Whether there is wall at a place, and on either side of it.
  bool isWall(const Eigen::Vector2d& place) const {
    return std::any_of(pieces.begin(), pieces.end(), [&](const Segment& piece) {
      const double along = piece.along(place);
      return piece.distance(place) < kAlign.door && along > kAlign.jamb &&
             along < piece.length() - kAlign.jamb;
    });
  }

  bool holdsWell(const Eigen::Vector2d& place) const {
    return std::any_of(rooms.begin(), rooms.end(), [&](const RoomOutline& room) {
      if (!room.contains(place)) return false;
      for (std::size_t i = 0; i < room.sides.size(); ++i) {
        if (room.side(i).distance(place) < kAlign.inside) return false;
      }
      return true;
    });
  }
};

// Length of b beside a, where both face the same way.
double shared(const Segment& a, const Segment& b) {
  if (a.direction().dot(b.direction()) < kAlign.parallel) return 0.0;
  const double from = std::max(0.0, a.along(b.start));
  const double to = std::min(a.length(), a.along(b.end));
  if (to <= from) return 0.0;
  const Eigen::Vector2d middle =
      b.start +
      0.5 * (b.along(a.start + from * a.direction()) + b.along(a.start + to * a.direction())) *
          b.direction();
  return std::abs(a.leftNormal().dot(middle - a.start)) < kAlign.near ? to - from : 0.0;
}

double agreement(const Building& found, const Building& known, const Pose2& T) {
  double sum = 0.0;
  for (const Segment& piece : found.pieces) {
    const Segment here = T * piece;
    for (const Segment& other : known.pieces) sum += shared(other, here);
  }
  return sum;
}

// What of one building contradicts another.
double contradiction(const Building& of, const Building& other, const Pose2& T_other_of) {
  double sum = 0.0;
  for (const Segment& piece : of.pieces) {
    const Segment here = T_other_of * piece;
    const double length = here.length();
    const int places = std::max(1, static_cast<int>(length / kAlign.step));
    for (int i = 0; i < places; ++i) {
      const double along = length * (i + 0.5) / places;
      if (other.holdsWell(here.start + along * here.direction())) sum += length / places;
    }
  }
  for (const Eigen::Vector2d& door : of.doors) {
    if (other.isWall(T_other_of * door)) sum += kAlign.door_price;
  }
  return sum;
}

// Moves the found walls onto those that they agree with.
Pose2 refined(const Building& found, const Building& known, Pose2 T) {
  for (int round = 0; round < kAlign.rounds; ++round) {
    Eigen::Matrix3d information = 1e-6 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const Segment& piece : found.pieces) {
      const Segment here = T * piece;
      for (const Segment& other : known.pieces) {
        const double weight = shared(other, here);
        if (weight <= 0.0) continue;
        const Eigen::Vector2d n = other.leftNormal();
        for (const Eigen::Vector2d& p : {here.start, here.end}) {
          const Eigen::Vector3d row(n.x(), n.y(), n.y() * p.x() - n.x() * p.y());
          information += weight * row * row.transpose();
          gradient += weight * n.dot(p - other.start) * row;
        }
      }
    }
    const Eigen::Vector3d step = -information.ldlt().solve(gradient);
    T = Pose2(step) * T;
  }
  return T;
}

struct Place {
  Pose2 T;
  double agreeing;
};

std::vector<Place> placesByCorners(const Building& found, const Building& known) {
  std::vector<Place> places;
  for (const Corner& corner : found.corners) {
    for (const Corner& other : known.corners) {
      if (std::abs(geometry::wrapAngle(corner.turn - other.turn)) > kAlign.corner) continue;
      const double turn = geometry::wrapAngle(other.angle - corner.angle);
      const Pose2 turned(0.0, 0.0, turn);
      const Pose2 T(other.place - turned * corner.place, turn);
      places.push_back({T, agreement(found, known, T)});
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.agreeing > b.agreeing; });
  return places;
}

bool areSame(const Pose2& a, const Pose2& b, const Eigen::Vector2d& about) {
  return (a * about - b * about).norm() < kAlign.same &&
         std::abs(geometry::wrapAngle(a.theta() - b.theta())) < kAlign.same_turn;
}

}  // namespace

bool RoomAlignment::isSure() const {
  return agreeing >= kAlign.least && agreeing >= kAlign.least_share * (agreeing + contradicted) &&
         rival <= kAlign.most_rival * score();
}

std::optional<RoomAlignment> alignRooms(const RoomLayout& found_layout,
                                        const RoomLayout& known_layout) {
  const Building found(found_layout);
  const Building known(known_layout);
  std::vector<RoomAlignment> all;
  for (const Place& place : placesByCorners(found, known)) {
    if (all.size() >= kAlign.refined) break;
    const Eigen::Vector2d about = found.rooms.front().anchor;
    const bool is_known = std::any_of(all.begin(), all.end(), [&](const RoomAlignment& other) {
      return areSame(other.T_known_found, place.T, about);
    });
    if (is_known) continue;
    const Pose2 T = refined(found, known, place.T);
    const double contradicted =
        contradiction(found, known, T) + contradiction(known, found, T.inverse());
    all.push_back({T, agreement(found, known, T), contradicted, 0.0});
  }
  if (all.empty()) return std::nullopt;
  std::stable_sort(all.begin(), all.end(), [](const RoomAlignment& a, const RoomAlignment& b) {
    return a.score() > b.score();
  });
  RoomAlignment best = all.front();
  if (all.size() > 1) best.rival = all[1].score();
  return best;
}

}  // namespace sightline::mapping
