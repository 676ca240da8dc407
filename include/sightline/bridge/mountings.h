#pragma once

#include <tf2_msgs/TFMessage.h>

#include "sightline/pipeline/offline_config.h"

namespace sightline::bridge {

/// Where the scanners sit on the base, as static transforms.
tf2_msgs::TFMessage mountingTransforms(const pipeline::OfflineConfig& config);

}  // namespace sightline::bridge
