#include "sightline/dead_reckoning/floor.h"

#include <cmath>

namespace sightline::dead_reckoning {

namespace {

// Of the beams of a tilted sweep, in the level frame that shares the scanner's heading.
class TiltedBeams {
 public:
  TiltedBeams(const scan::ScanGeometry& geometry, const SweepAttitude& attitude)
      : geometry_(geometry), attitude_(attitude) {}

  Eigen::Vector3d direction(std::size_t beam) const {
    const double duration = geometry_.timeOffsets().back();
    const double share = duration > 0.0 ? geometry_.timeOffsets()[beam] / duration : 0.0;
    const auto& [first, last] = attitude_;
    const geometry::Attitude now{first.roll + share * (last.roll - first.roll),
                                 first.pitch + share * (last.pitch - first.pitch)};
    return now.rotation() *
           Eigen::Vector3d(geometry_.cosines()[beam], geometry_.sines()[beam], 0.0);
  }

 private:
  const scan::ScanGeometry& geometry_;
  const SweepAttitude& attitude_;
};

}  // namespace

void FloorConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("height", height, {"m", {0.05, 10.0}, "of the scanner above the floor"});
  visitor.number("headroom", headroom,
                 {"m", {0.05, 100.0}, "from the scanner up to the ceiling, at least"});
  visitor.number(
      "max_tilt", max_tilt,
      {"rad", {0.01, 0.7}, "of the scanner from the horizontal, where none is measured"});
  visitor.number("tilt_sigma", tilt_sigma,
                 {"rad", {1e-4, 0.1}, "standard deviation of a measured pitch or roll"});
  visitor.integer("memory", memory,
                  {"1", {1, 100}, "scans that are looked back to for what stays where it is"});
}

std::vector<bool> beamsOnFloor(const FloorConfig& config, const scan::Scan& scan,
                               const SweepAttitude& attitude) {
  const TiltedBeams beams(*scan.geometry, attitude);
  std::vector<bool> on_floor(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    const double rise = beams.direction(i).z();
    const double doubt = 2.0 * config.tilt_sigma;
    if (std::abs(rise) < doubt) continue;  // as good as level
    const double reach = (rise < 0.0 ? config.height : config.headroom) / std::abs(rise);
    on_floor[i] = scan.ranges[i] > reach / (1.0 + doubt / std::abs(rise));
  }
  return on_floor;
}

scan::Scan levelled(const scan::Scan& scan, const SweepAttitude& attitude) {
  const TiltedBeams beams(*scan.geometry, attitude);
  scan::Scan level = scan;
  std::vector<double> angles;
  angles.reserve(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const Eigen::Vector3d direction = beams.direction(i);
    const double bearing = std::atan2(direction.y(), direction.x());
    // As many turns as the beam had: the angles have to go on in one sense.
    angles.push_back(scan.geometry->angles()[i] +
                     geometry::wrapAngle(bearing - scan.geometry->angles()[i]));
    level.ranges[i] *= direction.head<2>().norm();
  }
  level.geometry =
      std::make_shared<scan::ScanGeometry>(std::move(angles), scan.geometry->timeOffsets(),
                                           scan.geometry->rangeMin(), scan.geometry->rangeMax());
  return level;
}

scan::Scan without(scan::Scan scan, const std::vector<bool>& beams) {
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (beams[i]) scan.kinds[i] = scan::ReturnKind::kInvalid;
  }
  return scan;
}

}  // namespace sightline::dead_reckoning
