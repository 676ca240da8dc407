#pragma once

#include "sightline/pipeline/targets_config.h"

namespace sightline::nodes {

/// Parameters of the node target_tracker: those of the group `targets` in files of estimators.
using TargetTrackerNodeConfig = pipeline::TargetsConfig;

}  // namespace sightline::nodes
