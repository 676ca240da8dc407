#pragma once

#include <optional>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/geometry/angle.h"
#include "sightline/geometry/attitude.h"
#include "sightline/scan/scan.h"

/// Beams of a scanner that leans: what they hit of floor and ceiling is no wall (saarinen section
/// 4.3.4).
namespace sightline::motion {

/// Inclination of a scanner that a person carries, and its distance from floor and ceiling.
struct FloorConfig {
  double height = 1.2;                         ///< of the scanner above the floor [m]
  double headroom = 1.2;                       ///< from the scanner to the ceiling, at least [m]
  double max_tilt = geometry::radians(12.0);   ///< from the horizontal [rad]
  double tilt_sigma = geometry::radians(0.5);  ///< of a measured attitude [rad]
  int memory = 10;                             ///< scans that are looked back to

  void visit(config::FieldVisitor& visitor);
};

/// The attitude of a scanner at the first and the last beam of a sweep; it changes evenly.
struct SweepAttitude {
  geometry::Attitude first;
  geometry::Attitude last;
};

/// Finds the beams that ended on floor or ceiling by a measured attitude: those that came as far as
/// these are in their direction, `height / (sin α cos β)` at a pitch of α and a bearing of β, or
/// farther; or less by two standard deviations of the tilt.
std::vector<bool> beamsOnFloor(const FloorConfig& config, const scan::Scan& scan,
                               const SweepAttitude& attitude);

/// The scan as a level scanner at the same place would have measured it: ranges along the ground
/// (`l cos α` straight ahead) and the bearings that go with them. For tilts of less than half a
/// right angle. Throws scan::InvalidScan where beams would change their order.
scan::Scan levelled(const scan::Scan& scan, const SweepAttitude& attitude);

/// The scan with these beams made ReturnKind::kInvalid.
scan::Scan without(scan::Scan scan, const std::vector<bool>& beams);

}  // namespace sightline::motion
