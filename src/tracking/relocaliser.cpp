#include "sightline/tracking/relocaliser.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sightline/tracking/position_votes.h"
#include "sightline/tracking/surface_points.h"
#include "sightline/tracking/wall_alignment.h"

namespace sightline::tracking {

namespace {

using geometry::Pose2;

constexpr struct {
  double alike = 0.3;         // [m]
  double alike_turn = 0.105;  // 6° [rad]
  double tolerance = 0.1;     // of a beam that ends on a wall [m]
  double outside = 0.3;       // that a candidate may stand outside every room [m]
} kSearch;

struct Start {
  Pose2 T_map_sensor;
  double votes = 0.0;
};

std::vector<Start> startsOf(const world::RoomMap& map, const std::vector<SurfacePoint>& points,
                            const RelocaliserConfig& config) {
  const auto pieces = wallPieces(map);
  std::vector<Start> starts;
  for (const double frame : mainDirections(pieces)) {
    PositionVotes votes(pieces, frame, config.cell);
    for (const double direction : mainDirections(points)) {
      for (int quarter = 0; quarter < 4; ++quarter) {
        const double heading = frame - direction + 0.5 * geometry::kPi * quarter;
        for (const PositionVotes::Place& place : votes.of(points, heading)) {
          starts.push_back({Pose2(place.position_map, heading), place.votes});
        }
      }
    }
  }
  const std::size_t kept = std::min(starts.size(), config.most_starts);
  const auto heavier = [](const Start& a, const Start& b) { return a.votes > b.votes; };
  std::partial_sort(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(kept),
                    starts.end(), heavier);
  starts.resize(kept);
  return starts;
}

std::optional<std::size_t> roomNear(const world::RoomMap& map, const Eigen::Vector2d& position) {
  if (const auto room = map.roomAt(position)) return room;
  const std::size_t nearest = map.nearestRoom(position);
  if (map.rooms()[nearest].distance(position) > kSearch.outside) return std::nullopt;
  return nearest;
}

PoseCandidate judged(const world::RoomMap& map, const scan::Scan& scan, const Pose2& T_map_sensor,
                     std::size_t room, std::size_t stride) {
  const world::RoomView view(map, room, T_map_sensor.translation(), world::RoomView::Doors::kOpen);
  PoseCandidate candidate;
  candidate.T_map_base = T_map_sensor;
  candidate.room = room;
  candidate.agreement = scanAgreement(scan, T_map_sensor, view, kSearch.tolerance, stride);
  candidate.log_likelihood = logLikelihood(candidate.agreement, *scan.geometry());
  return candidate;
}

// The best candidates, apart from each other.
std::vector<PoseCandidate> thinned(std::vector<PoseCandidate> all,
                                   const RelocaliserConfig& config) {
  std::sort(all.begin(), all.end(), [](const PoseCandidate& a, const PoseCandidate& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  std::vector<PoseCandidate> kept;
  for (const PoseCandidate& candidate : all) {
    const double ratio = candidate.log_likelihood - all.front().log_likelihood;
    if (kept.size() >= config.most_candidates || ratio < config.least_log_ratio) break;
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const PoseCandidate& other) {
      return areAlike(candidate.T_map_base, other.T_map_base);
    });
    if (is_new) kept.push_back(candidate);
  }
  return kept;
}

}  // namespace

bool areAlike(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kSearch.alike &&
         std::abs(geometry::wrapAngle(a.theta() - b.theta())) < kSearch.alike_turn;
}

std::vector<PoseCandidate> relocalise(const world::RoomMap& map, const scan::Scan& scan,
                                      const Pose2& T_base_sensor, const RelocaliserConfig& config) {
  if (scan.beams() == 0 || map.rooms().empty()) return {};
  const auto points = surfacePoints(scan, config.most_beams);
  const std::size_t stride = std::max<std::size_t>(1, scan.beams() / config.most_beams);
  const WallAlignment alignment(map, points);
  std::vector<PoseCandidate> candidates;
  for (const Start& start : startsOf(map, points, config)) {
    const auto room = roomNear(map, start.T_map_sensor.translation());
    if (!room) continue;
    const Pose2 refined = alignment.refine(start.T_map_sensor, *room);
    const auto refined_room = roomNear(map, refined.translation());
    if (!refined_room) continue;
    candidates.push_back(judged(map, scan, refined, *refined_room, stride));
  }
  const Pose2 T_sensor_base = T_base_sensor.inverse();
  for (PoseCandidate& candidate : candidates) {
    candidate.T_map_base = candidate.T_map_base * T_sensor_base;
  }
  return thinned(std::move(candidates), config);
}

}  // namespace sightline::tracking
