#include "sightline/tracking/explanation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sightline/geometry/angle.h"
#include "sightline/tracking/jamb_finder.h"

namespace sightline::tracking {

namespace {

// Density of lines that are no wall where one is expected, for each that is [1/(m rad)]: furniture
// stands along walls in a third of the places, within a metre and 0.1 rad. From a third of it to
// three times as much, errors of a sensor of 40 degrees in a living room differ by 3 mm with its
// head held or informed.
constexpr double kOtherLines = 2.0;

// The best-seen wall first: it leaves the others the least room for error.
std::vector<std::size_t> byBeams(const std::vector<WallUpdate>& walls) {
  std::vector<std::size_t> order(walls.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return walls[a].acceptedBeams() > walls[b].acceptedBeams();
  });
  return order;
}

// Largest normalised innovation squared of a line that is rather the wall than furniture. A wide
// field shows it by the other walls. In a narrow one a line stands alone, and it is the wall where
// the density of its innovation is above that of other lines: the less certain the pose is, the
// sooner furniture is met where the wall is expected.
double mostNis(const WallConfig& config, const PoseFilter::Innovation& innovation,
               bool stands_alone) {
  if (!stands_alone) return config.max_nis;
  const double peak = 1.0 / (2.0 * geometry::kPi * std::sqrt(innovation.covariance.determinant()));
  return std::min(config.max_nis, 2.0 * std::log(peak / kOtherLines));
}

}  // namespace

std::vector<world::WallIndex> wallsInSight(const TrackingContext& context, std::size_t room) {
  std::vector<std::size_t> rooms{room};
  for (const world::Door& door : context.map.doors()) {
    for (const std::size_t side : {0U, 1U}) {
      const std::size_t other = door.rooms[side];
      const bool leads_there = context.config.neighbours && door.rooms[1 - side] == room;
      if (leads_there && std::find(rooms.begin(), rooms.end(), other) == rooms.end()) {
        rooms.push_back(other);
      }
    }
  }
  std::vector<world::WallIndex> walls;
  for (const std::size_t seen : rooms) {
    for (std::size_t wall = 0; wall < context.map.rooms()[seen].walls.size(); ++wall) {
      walls.push_back({seen, wall});
    }
  }
  return walls;
}

void applyWalls(const TrackingContext& context, const scan::ScanGeometry& geometry,
                PoseFilter& filter, std::vector<WallUpdate>& walls) {
  const bool stands_alone = !tellsPlacesApart(geometry);
  for (const std::size_t i : byBeams(walls)) {
    WallUpdate& wall = walls[i];
    if (!wall.fit) continue;
    const world::WallIndex index{wall.room, wall.wall};
    const world::Wall& known = context.map.wall(index);
    const geometry::Segment& expected = known.segment;
    const auto innovation =
        filter.innovation(wall.fit->line, expected.line(), wall.fit->motion_jacobian,
                          WallError(index, expected, context.config.wall.of(known)));
    wall.innovation = WallInnovation{innovation.value, innovation.nis};
    if (innovation.nis <= mostNis(context.config.wall, innovation, stands_alone)) {
      filter.update(innovation);
    } else {
      wall.refusal = WallRefusal::kOutsideGate;
    }
  }
}

void applyJambs(const TrackingContext& context, std::size_t room, const Sweep& sweep,
                PoseFilter& filter) {
  constexpr double kMostNis = 9.0;
  if (!context.config.doors.are_landmarks) return;
  for (const SeenJamb& seen : findJambs(context.config, filter, context.map, room, sweep)) {
    const auto innovation =
        filter.innovation(seen.line, seen.jamb.lineIn(context.map), LineBySweepError::Zero(),
                          seen.jamb.errorIn(context.config.doors));
    if (innovation.nis <= kMostNis) filter.update(innovation);
  }
}

double supportOf(const ScanAgreement& agreement, const scan::ScanGeometry& geometry) {
  return static_cast<double>(agreement.on_wall) * weightOf(agreement, geometry);
}

double unusedShare(const Explanation& explanation) {
  double used = 0.0;
  for (const WallUpdate& wall : explanation.walls) {
    if (wall.accepted()) used += static_cast<double>(wall.acceptedBeams());
  }
  const auto met = static_cast<double>(explanation.agreement.on_wall);
  return met > 0.0 ? std::max(0.0, 1.0 - used / met) : 0.0;
}

bool areWallsRefused(const std::vector<WallUpdate>& walls) {
  std::size_t accepted = 0;
  std::size_t refused = 0;
  for (const WallUpdate& wall : walls) {
    (wall.accepted() ? accepted : refused) += wall.acceptedBeams();
  }
  return refused > accepted;
}

double nisOf(const std::vector<WallUpdate>& walls) {
  double nis = 0.0;
  for (const WallUpdate& wall : walls) {
    if (wall.accepted() && wall.innovation) nis += wall.innovation->nis;
  }
  return nis;
}

}  // namespace sightline::tracking
