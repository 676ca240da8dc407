#include "sightline/geometry/attitude.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace sightline::geometry {

Eigen::Matrix3d Attitude::rotation() const {
  return (Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Attitude Attitude::of(const Eigen::Matrix3d& rotation) {
  return {std::atan2(rotation(2, 1), rotation(2, 2)),
          std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0))};
}

Attitude Attitude::seenFrom(double yaw) const {
  return of(rotation() * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

}  // namespace sightline::geometry
