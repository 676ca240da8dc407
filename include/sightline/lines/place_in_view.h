#pragma once

#include <Eigen/Core>

#include "sightline/scan/scan.h"

namespace sightline::lines {

/// What a scan has to say of a place.
enum class PlaceInView {
  kOutside,  ///< no beam went there, or it lies out of reach
  kHidden,   ///< something nearer stops the beams
  kSeen,     ///< the beams reach the place, or pass beside it
};

/// Judges by the beams that pass within `spread` [m] of a place in the scan's frame at its stamp.
PlaceInView lookAt(const Eigen::Vector2d& place, double spread, const scan::Scan& scan);

/// Bearing and range of a place at the time of the beam that points nearest to it.
struct PlaceAtBeam {
  std::size_t beam = 0;
  double bearing = 0.0;  ///< in the sensor's frame at that beam [rad]
  double range = 0.0;    ///< [m]
  bool in_field = false;
};
PlaceAtBeam beamTowards(const Eigen::Vector2d& place, const scan::Scan& scan);

}  // namespace sightline::lines
