#pragma once

#include <optional>
#include <vector>

#include "sightline/geometry/stamped_pose2.h"
#include "sightline/mapping/survey.h"
#include "sightline/motion/odometry_fit.h"
#include "sightline/pipeline/estimators_config.h"

namespace sightline::mapping {

/// Errors of the wheels by an adjusted path; nothing for a recording without wheels.
///
/// @param poses  of the scans of the survey, T_map_base
std::optional<motion::OdometryFit> fitWheels(const Survey& survey,
                                             const std::vector<geometry::StampedPose2>& poses);

/// The settings of a replay: its rooms are tracked with the systematic errors of the wheels known.
/// Their spreads stay those of the settings, as a path that took the wheels in shows them too
/// small.
pipeline::EstimatorsConfig withWheels(pipeline::EstimatorsConfig config,
                                      const std::optional<motion::OdometryFit>& wheels);

}  // namespace sightline::mapping
