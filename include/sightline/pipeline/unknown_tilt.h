#pragma once

#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"

namespace sightline::pipeline {

/// Adds what a tilt that nobody measures makes of pose, step and twist to their covariances.
///
/// A scanner that nods by α and rolls by β sees what is ahead farther by the factor 1 / cos α, what
/// is aside by 1 / cos β, and walls across its way turned by αβ, those along it not at all. No scan
/// shows that, and it does not add up: the pose errs by it, and a step at both its ends.
/// Oscillations with the amplitude τ give αβ the standard deviation τ²/2, and turn the view by half
/// of that.
///
/// @param max_tilt  of the scanner [rad]; its usual amplitude is a share of that
/// @param elapsed   time of the step [s]; 0 where there is none
void addUnknownTilt(double max_tilt, const scan::Scan& scan, const geometry::Pose2& T_base_sensor,
                    double elapsed, dead_reckoning::DeadReckoningUpdate& update);

}  // namespace sightline::pipeline
