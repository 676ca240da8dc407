#include "sightline/tracking/scan_agreement.h"

#include <limits>

namespace sightline::tracking {

namespace {

// Distance behind the wall at which a beam ended, along the wall's normal [m].
double excessOf(const scan::Scan& scan, std::size_t beam, const world::Sighting& sighting) {
  if (!scan.isValid(beam)) return std::numeric_limits<double>::infinity();
  return (scan.ranges()[beam] - sighting.range) * sighting.cos_incidence;
}

}  // namespace

ScanAgreement scanAgreement(const scan::Scan& scan, const geometry::Pose2& T_map_sensor,
                            const world::RoomView& view, double tolerance) {
  const Eigen::Matrix2d rotation = T_map_sensor.rotation();
  ScanAgreement agreement;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const bool nothing = scan.kinds()[i] == scan::ReturnKind::kNothing;
    if (!scan.isValid(i) && !nothing) continue;
    const auto sighting = view.look(rotation * scan.direction(i));
    if (!sighting || !sighting->is_solid || sighting->margin < tolerance) continue;
    if (nothing && sighting->range > scan.geometry()->rangeMax()) continue;
    const double excess = excessOf(scan, i, *sighting);
    if (excess > tolerance) {
      ++agreement.beyond;
    } else if (excess < -tolerance) {
      ++agreement.occluded;
    } else {
      ++agreement.on_wall;
    }
  }
  return agreement;
}

}  // namespace sightline::tracking
