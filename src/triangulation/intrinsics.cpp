#include "sightline/triangulation/intrinsics.h"

namespace sightline::triangulation {

void Intrinsics::visit(config::FieldVisitor& visitor) {
  visitor.number("focal_length", focal_length,
                 {"m", {1e-3, 1.0}, "f, from lens to detector (pears fig. 2)"});
  visitor.number("baseline", baseline,
                 {"m", {1e-3, 10.0}, "d, from the laser's centre of scan to the lens'"});
  visitor.number("vergence", vergence,
                 {"rad",
                  {0.0, geometry::radians(44.9)},
                  "gamma, of the optical axis towards the laser's; below 45 degrees"});
  visitor.number("lens_distance", lens_distance,
                 {"m", {0.0, 1.0}, "s, from the scanning mirror to the lens"});
  visitor.number("detector_length", detector_length,
                 {"m", {1e-4, 0.1}, "P; image positions are within half of it (pears eq. 1)"});
}

}  // namespace sightline::triangulation
