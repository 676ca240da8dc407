#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/config/node.h"
#include "sightline/geometry/segment.h"
#include "sightline/world/room_map.h"

namespace sightline::world {

/// How a surface answers light.
struct Material {
  std::string name = "plaster";
  double reflectivity =
      0.7;  ///< share of the light that comes back diffusely, (0, 1]; retro-reflectors may exceed 1
};

/// An upright plane piece: a wall, a side of a piece of furniture.
struct WorldSegment {
  geometry::Segment segment;
  double bottom = 0.0;       ///< [m] above the floor
  double top = 2.5;          ///< [m] above the floor
  std::size_t material = 0;  ///< index into World::materials()
};

/// An upright cylinder: a leg, a pillar, a pole.
struct WorldDisc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;  ///< [m]
  double bottom = 0.0;
  double top = 2.5;
  std::size_t material = 0;
};

/// A half line in space; the direction need not have unit length in the plane, a pitched one has a
/// z component.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();      ///< [m], z above the floor
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit vector
};

struct Hit {
  double range = 0.0;  ///< along the ray [m]
  std::size_t material = 0;
  double cos_incidence = 1.0;  ///< of the angle between ray and surface normal, in [0, 1]
};

}  // namespace sightline::world
