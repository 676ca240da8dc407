#pragma once

#include <vector>

#include "sightline/logs/carmen_log.h"

namespace sightline::logs {

/// The odometry of a log in the order of its stamps, one pose a stamp: the ODOM lines, which come
/// at the robot's own rate and say its velocity, or the poses that its scans carry, at
/// risingStamps(), where a log has fewer lines than one for every two scans or where the stamps of
/// its scans do not rise, as then those of the lines are wrong, too.
std::vector<CarmenOdometry> odometryOf(const CarmenLog& log);

/// Whether the odometry of a log says how the wheels turned, or only where the robot was.
bool hasVelocity(const CarmenLog& log);

/// Repairs odometry that counts forward while the robot backs: a step is turned round where its
/// direction contradicts the sign of the velocity at its end.
void reverseFromVelocity(std::vector<CarmenOdometry>& odometry);

}  // namespace sightline::logs
