#include "sightline/geometry/attitude.h"

#include <Eigen/Geometry>

namespace sightline::geometry {

Eigen::Matrix3d Attitude::rotation() const {
  return (Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace sightline::geometry
