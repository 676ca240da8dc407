#include "sightline/motion/floor.h"

#include <cmath>

namespace sightline::motion {

namespace {

// Directions of the beams of a tilted sweep, in the level frame that shares the scanner's heading.
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
  const TiltedBeams beams(*scan.geometry(), attitude);
  std::vector<bool> on_floor(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    const double rise = beams.direction(i).z();
    const double doubt = 2.0 * config.tilt_sigma;
    if (std::abs(rise) < doubt) continue;  // as good as level
    const double reach = (rise < 0.0 ? config.height : config.headroom) / std::abs(rise);
    on_floor[i] = scan.ranges()[i] > reach / (1.0 + doubt / std::abs(rise));
  }
  return on_floor;
}

namespace {

// The scan with other angles and ranges; kinds, noise and motion stay.
scan::Scan onGeometry(const scan::Scan& scan, std::shared_ptr<const scan::ScanGeometry> geometry,
                      std::vector<double> ranges) {
  scan::Scan result(std::move(geometry), scan.stamp, std::move(ranges), scan.intensities());
  for (std::size_t i = 0; i < scan.beams(); ++i) result.setKind(i, scan.kinds()[i]);
  result.setRangeVariances(scan.rangeVariances());
  result.setSensorMotion(scan.sensorMotion());
  result.frame = scan.frame;
  result.angular_variance = scan.angular_variance;
  result.transverse_variance = scan.transverse_variance;
  result.motion_noise = scan.motion_noise;
  return result;
}

}  // namespace

scan::Scan levelled(const scan::Scan& scan, const SweepAttitude& attitude) {
  const TiltedBeams beams(*scan.geometry(), attitude);
  std::vector<double> angles;
  std::vector<double> ranges = scan.ranges();
  angles.reserve(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const Eigen::Vector3d direction = beams.direction(i);
    const double bearing = std::atan2(direction.y(), direction.x());
    // Keeps the number of revolutions of the beam: the angles have to go on in one sense.
    angles.push_back(scan.geometry()->angles()[i] +
                     geometry::wrapAngle(bearing - scan.geometry()->angles()[i]));
    ranges[i] *= direction.head<2>().norm();
  }
  const auto geometry = std::make_shared<scan::ScanGeometry>(
      std::move(angles), scan.geometry()->timeOffsets(), scan.geometry()->rangeMin(),
      scan.geometry()->rangeMax());
  return onGeometry(scan, geometry, std::move(ranges));
}

scan::Scan without(scan::Scan scan, const std::vector<bool>& beams) {
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (beams[i]) scan.setKind(i, scan::ReturnKind::kInvalid);
  }
  return scan;
}

}  // namespace sightline::motion
