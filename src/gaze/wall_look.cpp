#include "sightline/gaze/wall_look.h"

#include <algorithm>
#include <cmath>

namespace sightline::gaze {

namespace {

constexpr struct {
  std::size_t every = 4;   // beam that is looked at
  double agrees = 0.1;     // a range that is so near to the map's is of the wall [m], and
  double sigmas = 4.0;     // its noise
  double obliquity = 0.2;  // of a wall that is hardly met [cosine]
} kBeams;

bool meetsWall(const scan::Scan& scan, std::size_t beam, const world::Sighting& sighting) {
  if (!scan.isValid(beam)) return false;
  const double sigma = std::sqrt(scan.rangeVariances()[beam]);
  return std::abs(scan.ranges()[beam] - sighting.range) < kBeams.agrees + kBeams.sigmas * sigma;
}

}  // namespace

std::vector<MappedBeam> mapBeams(const scan::Scan& scan, const world::RoomMap& map,
                                 std::size_t room, const geometry::Pose2& T_map_sensor) {
  const world::RoomView view(map, room, T_map_sensor.translation(), world::RoomView::Doors::kOpen);
  const Eigen::Matrix2d R = T_map_sensor.rotation();
  std::vector<MappedBeam> beams;
  for (std::size_t beam = 0; beam < scan.beams(); beam += kBeams.every) {
    const auto sighting = view.look(R * scan.direction(beam));
    if (!sighting || !sighting->is_solid || sighting->cos_incidence < kBeams.obliquity ||
        sighting->range > scan.geometry()->rangeMax()) {
      continue;
    }
    const double variance = scan.isValid(beam) ? scan.rangeVariances()[beam] : 0.0;
    beams.push_back({*sighting, variance / static_cast<double>(kBeams.every),
                     meetsWall(scan, beam, *sighting)});
  }
  return beams;
}

WallLook& WallLooks::of(const world::WallIndex& wall) {
  const auto known = std::find_if(looks_.begin(), looks_.end(), [&](const WallLook& look) {
    return look.wall.room == wall.room && look.wall.wall == wall.wall;
  });
  if (known != looks_.end()) return *known;
  const geometry::Segment& segment = map_->wall(wall).segment;
  looks_.push_back({wall, 0.5 * (segment.start + segment.end), segment.leftNormal()});
  return looks_.back();
}

// The distance of the beam's end from the wall is known across the wall alone.
void WallLooks::add(const world::Sighting& sighting, double weight) {
  WallLook& look = of(sighting.wall);
  const double across = weight / (sighting.cos_incidence * sighting.cos_incidence);
  const double half = 0.5 * map_->wall(sighting.wall).segment.length();
  const Eigen::Vector2d error(1.0, sighting.along - half);
  look.information += across * error * error.transpose();
  look.from = std::min(look.from, sighting.along);
  look.to = std::max(look.to, sighting.along);
}

}  // namespace sightline::gaze
