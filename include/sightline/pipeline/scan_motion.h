#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"

namespace sightline::pipeline {

/// The carrier's pose in the odometry frame at a time [ns]; nothing where the odometry does not
/// reach.
using OdometryAt = std::function<std::optional<geometry::Pose2>(std::int64_t)>;

/// Fills in how the sensor moved during the sweep, and returns the odometry at the stamp of the
/// scan. Nothing, and a scan left as it was, where the odometry knows either end of the sweep not.
std::optional<geometry::Pose2> addMotion(scan::Scan& scan, const OdometryAt& odometry,
                                         const geometry::Pose2& T_base_sensor);

}  // namespace sightline::pipeline
