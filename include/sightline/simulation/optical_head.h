#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "sightline/config/fields.h"
#include "sightline/triangulation/calibration.h"
#include "sightline/triangulation/photocurrents.h"
#include "sightline/triangulation/projection_geometry.h"
#include "sightline/world/world.h"

namespace sightline::simulation {

/// Laser, lens and detector of a simulated synchronised-scan sensor. The defaults give the currents
/// of pears table 2 for a white target.
struct Optics {
  int rays = 9;                    ///< across the laser beam
  double beam_width = 0.003;       ///< [m], between the points of 1/e² of the power density
  double laser_power = 0.9e-3;     ///< [W]
  double responsivity = 0.45;      ///< of the detector [A/W]
  double lens_diameter = 0.01625;  ///< [m]

  void visit(config::FieldVisitor& visitor);
};

/// Image of the laser spot on the detector.
struct SpotImage {
  double current = 0.0;         ///< [A], of all rays
  double image_position = 0.0;  ///< [m], weighted by their currents; 0 where there is no light
};

/// Path of the light from the laser to the detector (pears section 3.3), without noise.
class OpticalHead {
 public:
  /// Throws config::Error.
  OpticalHead(const triangulation::Intrinsics& intrinsics, const Optics& optics);

  /// The spot of the beam that points to `angle` [rad] in the projection frame. Parallel rays
  /// across the beam sample its Gaussian profile; each goes to the nearest surface, and from there
  /// to the lens, unless something is in between; a surface scatters by Lambert's law, so that a
  /// ray brings power · responsivity · reflectivity · cos(angle to the normal) · (lens diameter /
  /// 2 / range from the lens)², where its image falls on the detector.
  SpotImage look(const world::World& world, const Eigen::Isometry3d& T_map_projection,
                 double angle) const;

  const triangulation::ProjectionGeometry& geometry() const { return geometry_; }

 private:
  struct BeamRay {
    double offset;  // [m], to the left of the beam's axis
    double share;   // of the laser's power
  };
  static std::vector<BeamRay> raysOf(const Optics& optics);
  // End of a ray of the beam.
  struct Spot {
    world::Hit hit;
    Eigen::Vector3d source_map;  // where the ray left
    Eigen::Vector3d point_map;
    double full_current;  // if the surface is white and faces the lens, times squared range [A m²]
    double image_position;  // [m]
  };
  std::vector<Spot> illuminate(const world::World& world, const Eigen::Isometry3d& T_map_projection,
                               double angle) const;
  static double gatheredCurrent(const world::World& world, const Spot& spot,
                                const Eigen::Vector3d& lens_map,
                                const world::World::Shortlist& between);

  triangulation::ProjectionGeometry geometry_;
  std::vector<BeamRay> rays_;
  double full_current_;  // of a white surface facing the lens, times squared range [A m²]
};

}  // namespace sightline::simulation
