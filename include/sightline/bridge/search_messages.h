#pragma once

#include <string>
#include <vector>

#include <nav_msgs/Path.h>
#include <visualization_msgs/MarkerArray.h>

#include "sightline/targets/search.h"

namespace sightline::bridge {

/// The poses of an action, in order.
nav_msgs::Path toMessage(const targets::SearchAction& action, std::int64_t stamp,
                         const std::string& frame);
/// The way of each robot with the poses at which it will look.
visualization_msgs::MarkerArray toMarkers(const std::vector<targets::SearchAction>& actions,
                                          std::int64_t stamp, const std::string& frame);

}  // namespace sightline::bridge
