#include "wall_unevenness.h"

#include <algorithm>
#include <cmath>

namespace sightline::mapping {

namespace {

// Sums over the sightings of a side.
struct Unevenness {
  double sightings = 0.0;
  double offset = 0.0;     // squared [m²]
  double weight = 0.0;     // of turns: a long stretch tells more
  double direction = 0.0;  // squared, less what noise explains [rad²], by weight

  void add(const Eigen::Vector2d& ends, double spread, double noise) {
    const double middle = 0.5 * (ends[0] + ends[1]);
    const double turn = (ends[1] - ends[0]) / (2.0 * spread);
    const double turn_variance = 0.5 * noise * noise / (spread * spread);
    sightings += 1.0;
    offset += middle * middle;
    weight += 1.0 / turn_variance;
    direction += turn * turn / turn_variance - 1.0;
  }
  Eigen::Vector2d sigmas() const {
    if (sightings == 0.0) return Eigen::Vector2d::Zero();
    return {std::sqrt(offset / sightings), std::sqrt(std::max(0.0, direction / weight))};
  }
};

}  // namespace

void measureUnevenness(const std::vector<SideSighting>& sightings,
                       const std::vector<geometry::Pose2>& poses, std::vector<RoomOutline>& rooms) {
  std::vector<std::vector<Unevenness>> sums(rooms.size());
  for (std::size_t r = 0; r < rooms.size(); ++r) sums[r].resize(rooms[r].sides.size());
  for (const SideSighting& sighting : sightings) {
    const RoomOutline& room = rooms[sighting.room];
    const SideLine& side = room.sides[sighting.side];
    Eigen::Vector2d ends;
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2d place = poses[sighting.key] * sighting.ends_base[i];
      ends[i] = side.normal().dot(place - room.anchor) - side.distance;
    }
    const double spread = 0.5 * (sighting.ends_base[1] - sighting.ends_base[0]).norm();
    sums[sighting.room][sighting.side].add(ends, spread, sighting.noise);
  }
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    for (std::size_t i = 0; i < rooms[r].sides.size(); ++i) {
      rooms[r].sides[i].unevenness = sums[r][i].sigmas();
    }
  }
}

}  // namespace sightline::mapping
