#include "sightline/simulation/mounting.h"

#include "sightline/geometry/angle.h"

namespace sightline::simulation {

void Mounting::visit(config::FieldVisitor& visitor) {
  visitor.number("x", x, {"m", {-100.0, 100.0}, "of the sensor on the robot, forward"});
  visitor.number("y", y, {"m", {-100.0, 100.0}, "left"});
  visitor.number("z", z, {"m", {0.0, 100.0}, "above the floor"});
  const config::Range turn{-2.0 * geometry::kPi, 2.0 * geometry::kPi};
  visitor.number("roll", roll, {"rad", turn, "about the robot's x axis; pi: upside down"});
  visitor.number("pitch", pitch, {"rad", turn, "about the robot's y axis; positive looks down"});
  visitor.number("yaw", yaw, {"rad", turn, "about the robot's z axis"});
}

Eigen::Isometry3d Mounting::T_base_sensor() const {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

}  // namespace sightline::simulation
