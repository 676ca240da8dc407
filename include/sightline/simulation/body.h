#pragma once

#include "sightline/config/fields.h"

namespace sightline::simulation {

/// Shape of something that moves, as scanners see it: an upright cylinder about its middle, a plane
/// piece through its middle, across its heading, or both.
struct Body {
  double radius = 0.25;       ///< of the cylinder [m]; 0: none
  double width = 0.0;         ///< of the plane piece [m]; 0: none
  double bottom = 0.0;        ///< [m] above the floor
  double top = 1.0;           ///< [m] above the floor
  double reflectivity = 0.7;  ///< share of the light that comes back diffusely

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error naming `source` where a value is out of range or two do not fit.
  void check(const std::string& source) const;
};

}  // namespace sightline::simulation
