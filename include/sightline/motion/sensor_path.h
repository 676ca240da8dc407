#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan_geometry.h"

namespace sightline::motion {

/// Pose of something in a frame that stands still, so many seconds after the stamp of a scan;
/// nothing where it is not known.
using PoseAfter = std::function<std::optional<geometry::Pose2>(double)>;

/// Longest time over which a velocity is taken as constant [s]: odometry comes at 50 Hz.
constexpr double kStretch = 0.02;

/// Pose at each beam, in the frame at the stamp, of something whose path is known: of constant body
/// velocity over each stretch of at most kStretch. Empty where it stood still or all beams are
/// taken at once; nothing where the path is not known from the stamp to the last beam.
std::optional<std::vector<geometry::Pose2>> sweepAlong(const PoseAfter& path,
                                                       const scan::ScanGeometry& geometry);

}  // namespace sightline::motion
