#pragma once

#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

#include "sightline/gaze/wall_look.h"

namespace sightline::gaze {

/// Remembers which stretches of the walls of a map have been seen, and which are hidden by things
/// that the map does not hold.
class WallVisibility {
 public:
  /// What was found is forgotten in the time `forget` [s].
  explicit WallVisibility(double forget) : forget_(forget) {}

  /// Takes the beams of a scan, so long after those before [s].
  void take(const std::vector<MappedBeam>& beams, double elapsed);
  /// Probability that a beam meets the wall where the map says so.
  double at(const world::Sighting& sighting) const;
  void clear() { stretches_.clear(); }

 private:
  using Stretch = std::tuple<std::size_t, std::size_t, int>;  // room, wall, place
  struct Count {
    double seen = 0.0;
    double hidden = 0.0;
  };
  static Stretch stretchOf(const world::Sighting& sighting);
  void fade(double elapsed);

  double forget_;
  std::map<Stretch, Count> stretches_;
};

}  // namespace sightline::gaze
