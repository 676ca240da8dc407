#include "sightline/tracking/wall_report.h"

#include <algorithm>
#include <cmath>

namespace sightline::tracking {

namespace {

// Distance of a line from where the map has its wall, at the foot of the perpendicular from the
// robot, into the room.
double offsetOf(const WallUpdate& seen, const world::Wall& wall,
                const geometry::Pose2& T_map_base) {
  const geometry::Pose2 T_base_map = T_map_base.inverse();
  const auto expected = geometry::transform(T_base_map, wall.segment.line());
  const auto line = geometry::describedLike(expected, seen.fit->line);
  const Eigen::Vector2d inwards = T_base_map.rotation() * wall.segment.leftNormal();
  return (line.rho - expected.rho) * (expected.normal().dot(inwards) > 0.0 ? 1.0 : -1.0);
}

}  // namespace

bool WallUse::isSuspect(double offset) const {
  return std::abs(mean_offset) > offset || 2 * used < fitted;
}

void WallReport::add(const TrackerUpdate& update, const world::RoomMap& map) {
  if (update.state != TrackerState::kTracking) return;
  for (const WallUpdate& seen : update.walls) {
    if (!seen.fit) continue;
    Sums& sums = sums_[{seen.room, seen.wall}];
    const double offset = offsetOf(seen, map.wall({seen.room, seen.wall}), update.pose.mean);
    ++sums.fitted;
    sums.used += seen.accepted() ? 1 : 0;
    sums.offset += offset;
    sums.square += offset * offset;
  }
}

std::vector<WallUse> WallReport::uses(const world::RoomMap& map) const {
  std::vector<WallUse> uses;
  for (const auto& [index, sums] : sums_) {
    if (index.first >= map.rooms().size()) continue;
    const world::Room& room = map.rooms()[index.first];
    if (index.second >= room.walls.size()) continue;
    const auto count = static_cast<double>(sums.fitted);
    const double mean = sums.offset / count;
    const double variance = std::max(0.0, sums.square / count - mean * mean);
    uses.push_back({room.name, room.walls[index.second].name, sums.fitted, sums.used, mean,
                    std::sqrt(variance)});
  }
  return uses;
}

}  // namespace sightline::tracking
