#pragma once

#include <vector>

#include "sightline/logs/carmen_log.h"

namespace sightline::logs {

/// The odometry of a log in the order of its stamps, one pose a stamp: the ODOM lines, which come
/// at the robot's own rate and say its velocity, or, where a log has fewer than one for every two
/// scans, the poses that its scans carry.
std::vector<CarmenOdometry> odometryOf(const CarmenLog& log);

/// Whether the odometry of a log says how the wheels turned, or only where the robot was.
bool hasVelocity(const CarmenLog& log);

/// Repairs odometry that counts forward while the robot backs: a step is turned round where its
/// direction contradicts the sign of the velocity at its end.
void reverseFromVelocity(std::vector<CarmenOdometry>& odometry);

}  // namespace sightline::logs
