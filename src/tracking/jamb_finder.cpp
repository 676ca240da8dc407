#include "sightline/tracking/jamb_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sightline/tracking/gated_wall.h"

namespace sightline::tracking {

namespace {

using geometry::PolarLine;
using geometry::Pose2;

constexpr struct {
  // A span that ends this near to the opening is solid up to the jamb [m].
  double span_end = 0.02;
  // Widest gap between the beam on the wall and the one past it, measured along the wall [m].
  double widest_gap = 0.3;
  double slack = 0.03;           // of a beam on the wall: what walls are not straight by [m]
  double least_depth = 0.08;     // that a beam passes behind the wall [m]
  double least_distance = 0.15;  // of the sensor from the wall [m]
  // Standard deviation of a direction that is not known [rad].
  double any_direction = 1.0;
} kJambs;

double squareOf(double value) {
  return value * value;
}

// A beam as seen along a wall.
struct BeamAtWall {
  double depth;  // of its end behind the wall [m]
  double along;  // where it ends on the wall or passes through [m]
  bool is_on_wall;
  bool is_through;
};

class WallFrame {
 public:
  WallFrame(const geometry::Segment& segment_map, const Pose2& T_base_map) {
    const geometry::Segment segment = T_base_map * segment_map;
    start_ = segment.start;
    direction_ = segment.direction();
    normal_ = segment.leftNormal();
  }

  BeamAtWall look(const BeamPoint& point) const {
    const double from = normal_.dot(point.origin - start_);
    const double to = normal_.dot(point.position - start_);
    const double sigma = pointSigma(point, normal_);
    BeamAtWall beam{-to, 0.0, false, false};
    if (from < kJambs.least_distance) return beam;
    beam.is_on_wall = std::abs(to) <= 3.0 * sigma + kJambs.slack;
    beam.is_through = -to > 3.0 * sigma + kJambs.least_depth;
    const double share = beam.is_through ? from / (from - to) : 1.0;
    const Eigen::Vector2d place = point.origin + share * (point.position - point.origin);
    beam.along = direction_.dot(place - start_);
    return beam;
  }

  // Line across the wall at a place on it, whose direction is unknown.
  PolarLine lineAcross(double along, double sigma) const {
    const Eigen::Vector2d place = start_ + along * direction_;
    const double arm = normal_.dot(place);
    const double direction = squareOf(kJambs.any_direction);
    PolarLine line;
    line.phi = std::atan2(direction_.y(), direction_.x());
    line.rho = direction_.dot(place);
    line.covariance << squareOf(sigma) + arm * arm * direction, arm * direction, arm * direction,
        direction;
    return geometry::canonical(line);
  }

 private:
  Eigen::Vector2d start_;
  Eigen::Vector2d direction_;
  Eigen::Vector2d normal_;
};

// An end of the wall in the scan, and which side of it is open.
struct Edge {
  double along = 0.0;
  double sigma = 0.0;
  bool opens = false;  // whether the opening lies beyond it in the direction of the wall
};

std::vector<Edge> edgesOf(const WallFrame& wall, const Sweep& sweep) {
  std::vector<Edge> edges;
  for (std::size_t i = 1; i < sweep.points.size(); ++i) {
    if (sweep.points[i].beam != sweep.points[i - 1].beam + 1) continue;
    const BeamAtWall a = wall.look(sweep.points[i - 1]);
    const BeamAtWall b = wall.look(sweep.points[i]);
    if (!(a.is_on_wall && b.is_through) && !(a.is_through && b.is_on_wall)) continue;
    const double gap = std::abs(b.along - a.along);
    if (gap > kJambs.widest_gap) continue;
    const double on_wall = a.is_on_wall ? a.along : b.along;
    const double through = a.is_on_wall ? b.along : a.along;
    edges.push_back({0.5 * (a.along + b.along), gap / std::sqrt(12.0), through > on_wall});
  }
  return edges;
}

void addJambs(const world::RoomMap& map, std::size_t door_index, std::size_t side,
              std::vector<Jamb>& jambs) {
  const world::Door& door = map.doors()[door_index];
  const world::Wall& wall = map.rooms()[door.rooms[side]].walls[door.walls[side]];
  const world::Span opening = world::openingOf(door, wall);
  for (const world::Span& span : wall.spans) {
    const auto isNear = [](double a, double b) { return std::abs(a - b) < kJambs.span_end; };
    if (isNear(span.to, opening.from)) {
      jambs.push_back({door_index, door.rooms[side], true, opening.from});
    }
    if (isNear(span.from, opening.to)) {
      jambs.push_back({door_index, door.rooms[side], false, opening.to});
    }
  }
}

// The one edge in a jamb's gate; nothing where there are more.
std::optional<Edge> edgeFor(const Jamb& jamb, const std::vector<Edge>& edges, double sigmas,
                            double sigma) {
  std::optional<Edge> found;
  for (const Edge& edge : edges) {
    const double reach = sigmas * std::hypot(sigma, edge.sigma);
    if (edge.opens != jamb.is_start || std::abs(edge.along - jamb.along) > reach) continue;
    if (found) return std::nullopt;
    found = edge;
  }
  return found;
}

const geometry::Segment& segmentOf(const world::RoomMap& map, const Jamb& jamb) {
  const world::Door& door = map.doors()[jamb.door];
  const std::size_t side = door.rooms[0] == jamb.room ? 0 : 1;
  return map.rooms()[jamb.room].walls[door.walls[side]].segment;
}

}  // namespace

PolarLine Jamb::lineIn(const world::RoomMap& map) const {
  const geometry::Segment& wall = segmentOf(map, *this);
  PolarLine line;
  line.phi = std::atan2(wall.direction().y(), wall.direction().x());
  line.rho = wall.direction().dot(wall.start) + along;
  return geometry::canonical(line);
}

WallError Jamb::errorIn(const DoorConfig& config) const {
  WallError error;
  error.wall = {std::numeric_limits<std::size_t>::max() - door, 2 * room + (is_start ? 0 : 1)};
  error.covariance(0, 0) = squareOf(config.position_sigma);
  return error;
}

std::vector<SeenJamb> findJambs(const TrackerConfig& config, const PoseFilter& filter,
                                const world::RoomMap& map, std::size_t room, const Sweep& sweep) {
  std::vector<Jamb> jambs;
  for (std::size_t i = 0; i < map.doors().size(); ++i) {
    for (const std::size_t side : {0U, 1U}) {
      if (map.doors()[i].rooms[side] == room) addJambs(map, i, side, jambs);
    }
  }
  const geometry::UncertainPose2 pose = filter.assumedPose();
  const Pose2 T_base_map = pose.mean.inverse();
  std::vector<SeenJamb> seen;
  const geometry::Segment* last = nullptr;
  std::vector<Edge> edges;
  for (const Jamb& jamb : jambs) {
    const geometry::Segment& segment = segmentOf(map, jamb);
    const Eigen::Vector2d along = segment.direction();
    const double variance = along.dot(pose.covariance.topLeftCorner<2, 2>() * along);
    if (variance < squareOf(config.doors.asked_from)) continue;
    const WallFrame wall(segment, T_base_map);
    if (&segment != last) edges = edgesOf(wall, sweep);
    last = &segment;
    const double sigma = std::hypot(std::sqrt(variance), config.doors.position_sigma);
    const auto edge = edgeFor(jamb, edges, config.gate.sigmas, sigma);
    if (edge) seen.push_back({jamb, wall.lineAcross(edge->along, edge->sigma)});
  }
  return seen;
}

}  // namespace sightline::tracking
