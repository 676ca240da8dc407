#pragma once

#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sightline/BearingArray.h>
#include <sightline/TargetArray.h>
#include <visualization_msgs/MarkerArray.h>

#include "sightline/logs/ospa.h"
#include "sightline/targets/target_filter.h"

namespace sightline::bridge {

/// Throws BadMessage where a field is missing or makes no sense.
targets::BearingSet toBearingSet(const BearingArray& message);
BearingArray toMessage(const targets::BearingSet& set, const std::string& frame);

/// A pose with its covariance in the plane. Throws BadMessage where it is none.
geometry::UncertainPose2 toUncertainPose2(const geometry_msgs::PoseWithCovarianceStamped& message);

TargetArray toMessage(const targets::TargetEstimate& estimate, const std::string& frame);
/// Ellipses that hold 95 %, with the label of each target above it.
visualization_msgs::MarkerArray toMarkers(const targets::TargetEstimate& estimate,
                                          const std::string& frame);
/// Places where targets truly are, [m] in the frame.
visualization_msgs::MarkerArray toMarkers(const logs::Points& truth, std::int64_t stamp,
                                          const std::string& frame);
/// Probability of a target in each cell, in percent.
nav_msgs::OccupancyGrid toMessage(const targets::IntensityGrid& grid, std::int64_t stamp,
                                  const std::string& frame);

}  // namespace sightline::bridge
