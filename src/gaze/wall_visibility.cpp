#include "sightline/gaze/wall_visibility.h"

#include <algorithm>
#include <cmath>

namespace sightline::gaze {

namespace {

constexpr struct {
  double stretch = 0.25;  // of wall that is seen or hidden as one [m]
  // What is thought of a wall that nobody has looked at, as beams that met it and did not.
  double seen = 3.0;
  double hidden = 1.0;
  double most = 30.0;  // beams that are remembered
} kVisibility;

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

void WallVisibility::take(const std::vector<MappedBeam>& beams, double elapsed) {
  fade(elapsed);
  for (const MappedBeam& beam : beams) {
    Count& count = stretches_[stretchOf(beam.sighting)];
    double& side = beam.meets_wall ? count.seen : count.hidden;
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
