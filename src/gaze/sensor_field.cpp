#include "sightline/gaze/sensor_field.h"

#include <cmath>

namespace sightline::gaze {

void SensorField::visit(config::FieldVisitor& visitor) {
  const config::Range angle{-geometry::kPi, geometry::kPi};
  visitor.number("half_width", half_width, {"rad", {0.01, geometry::kPi}, "of the field of view"});
  visitor.number("centre", centre, {"rad", angle, "middle of the field in the head's frame"});
  visitor.number("range_min", range_min, {"m", {0.0, 1e3}, "nearest range"});
  visitor.number("range_max", range_max, {"m", {0.01, 1e3}, "farthest range"});
  visitor.number("origin_x", origin_x, {"m", {-10.0, 10.0}, "of the beams, in the head's frame"});
  visitor.number("origin_y", origin_y, {"m", {-10.0, 10.0}, "of the beams, in the head's frame"});
  visitor.integer("beams", beams, {"1", {2, 1e6}, "of a scan"});
  visitor.number("range_sigma", range_sigma, {"m", {1e-6, 10.0}, "of a range at 1 m"});
  visitor.number("range_exponent", range_exponent,
                 {"1", {0.0, 8.0}, "power of the range by which it grows (pears table 2: 4.1)"});
}

double SensorField::sigmaAt(double range) const {
  return range_sigma * std::pow(range, range_exponent);
}

geometry::Pose2 SensorField::T_mount_sensor(double head_angle) const {
  return geometry::Pose2(0.0, 0.0, head_angle) * geometry::Pose2(origin_x, origin_y, centre);
}

// The middle beam runs beside the axis at a distance; the place has to be at that distance, too.
double SensorField::aimAt(const Eigen::Vector2d& place_mount) const {
  const double beside = origin_y * std::cos(centre) - origin_x * std::sin(centre);
  const double distance = place_mount.norm();
  const double bearing = std::atan2(place_mount.y(), place_mount.x());
  const double offset = std::abs(beside) < distance ? std::asin(beside / distance) : 0.0;
  return geometry::wrapAngle(bearing - centre - offset);
}

bool SensorField::holds(const Eigen::Vector2d& place_mount, double head_angle) const {
  const Eigen::Vector2d seen = T_mount_sensor(head_angle).inverse() * place_mount;
  const double range = seen.norm();
  return range >= range_min && range <= range_max &&
         std::abs(std::atan2(seen.y(), seen.x())) <= half_width;
}

}  // namespace sightline::gaze
