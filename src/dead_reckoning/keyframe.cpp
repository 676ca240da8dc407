#include "sightline/dead_reckoning/keyframe.h"

#include <algorithm>

namespace sightline::dead_reckoning {

namespace {

constexpr struct {
  // Points that are compared: one in so many.
  std::size_t stride = 3;
  // Least share of the points of which the other knows what there is, for the two to be compared.
  double known = 0.3;
  // Share of those that one looks through: people and doors stay below the first, scans of
  // different places are above the second.
  double agreeing = 0.12;
  double contradicting = 0.3;
} kCompare;

// Points of one keyframe as the other sees them.
struct Sightings {
  double points = 0.0;
  double on_surface = 0.0;
  double in_free = 0.0;

  void add(const Keyframe& seen, const Keyframe& by) {
    for (std::size_t i = 0; i < seen.points.size(); i += kCompare.stride) {
      const Eigen::Vector2d place = seen.T_odom_base * seen.points[i].position;
      const Sight sight = by.profile.at(by.R_base_odom * (place - by.T_odom_base.translation()));
      points += 1.0;
      if (sight == Sight::kSurface) on_surface += 1.0;
      if (sight == Sight::kFree) in_free += 1.0;
    }
  }
  double known() const { return on_surface + in_free; }
};

}  // namespace

void compare(Keyframe& a, Keyframe& b) {
  if (a.scanner != b.scanner) return;
  Sightings sightings;
  sightings.add(a, b);
  sightings.add(b, a);
  if (sightings.known() <= kCompare.known * sightings.points) return;
  const double share = sightings.in_free / sightings.known();
  for (Keyframe* keyframe : {&a, &b}) {
    if (share < kCompare.agreeing) ++keyframe->agreeing;
    if (share > kCompare.contradicting) ++keyframe->contradicting;
  }
}

}  // namespace sightline::dead_reckoning
