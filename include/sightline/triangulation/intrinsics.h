#pragma once

#include "sightline/config/fields.h"
#include "sightline/geometry/angle.h"

namespace sightline::triangulation {

/// Parameters in which one synchronised-scan sensor differs from the next (pears fig. 2): a laser
/// is scanned about the origin of the projection frame, and, in synchronism, a lens is scanned
/// about a point q beside it, with a position-sensitive detector behind the lens.
struct Intrinsics {
  double focal_length = 0.050;                ///< f [m], from the lens to the detector
  double baseline = 0.0849;                   ///< d [m], from the laser's centre of scan to q
  double vergence = geometry::radians(6.87);  ///< γ [rad], of the lens' axis towards the laser
  double lens_distance = 0.020;               ///< s [m], from the scanning mirror to the lens
  double detector_length = 0.010;             ///< P [m]; image positions are within ±P/2

  void visit(config::FieldVisitor& visitor);
};

}  // namespace sightline::triangulation
