#include "sightline/gaze/wall_visibility.h"

#include <cmath>

namespace sightline::gaze {

namespace {

constexpr struct {
  double stretch = 0.25;   // of wall that is seen or hidden as one [m]
  std::size_t every = 4;   // beam that is looked at
  double agrees = 0.1;     // a range that is so near to the map's is of the wall [m], and
  double sigmas = 4.0;     // its noise
  double obliquity = 0.2;  // of a wall that is hardly met [cosine]
  // What is thought of a wall that nobody has looked at, as beams that met it and did not.
  double seen = 3.0;
  double hidden = 1.0;
  double most = 30.0;  // beams that are remembered
} kVisibility;

bool meetsWall(const scan::Scan& scan, std::size_t beam, const world::Sighting& sighting) {
  if (!scan.isValid(beam)) return false;
  const double sigma = std::sqrt(scan.rangeVariances()[beam]);
  return std::abs(scan.ranges()[beam] - sighting.range) <
         kVisibility.agrees + kVisibility.sigmas * sigma;
}

}  // namespace

WallVisibility::Stretch WallVisibility::stretchOf(const world::Sighting& sighting) {
  return {sighting.wall.room, sighting.wall.wall,
          static_cast<int>(sighting.along / kVisibility.stretch)};
}

void WallVisibility::fade(double elapsed) {
  const double kept = std::exp(-elapsed / forget_);
  for (auto& [stretch, count] : stretches_) {
    count.seen *= kept;
    count.hidden *= kept;
  }
}

void WallVisibility::take(const scan::Scan& scan, const world::RoomMap& map, std::size_t room,
                          const geometry::Pose2& T_map_sensor, double elapsed) {
  fade(elapsed);
  const world::RoomView view(map, room, T_map_sensor.translation(), world::RoomView::Doors::kOpen);
  const Eigen::Matrix2d R = T_map_sensor.rotation();
  for (std::size_t beam = 0; beam < scan.beams(); beam += kVisibility.every) {
    const auto sighting = view.look(R * scan.direction(beam));
    if (!sighting || !sighting->is_solid || sighting->cos_incidence < kVisibility.obliquity ||
        sighting->range > scan.geometry()->rangeMax()) {
      continue;
    }
    Count& count = stretches_[stretchOf(*sighting)];
    double& side = meetsWall(scan, beam, *sighting) ? count.seen : count.hidden;
    side = std::min(kVisibility.most, side + 1.0);
  }
}

double WallVisibility::at(const world::Sighting& sighting) const {
  const auto found = stretches_.find(stretchOf(sighting));
  const Count count = found == stretches_.end() ? Count{} : found->second;
  const double seen = kVisibility.seen + count.seen;
  return seen / (seen + kVisibility.hidden + count.hidden);
}

}  // namespace sightline::gaze
