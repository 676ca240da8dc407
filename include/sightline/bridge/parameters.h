#pragma once

#include <string>

#include <ros/node_handle.h>

#include "sightline/config/fields.h"

/// Configuration structs from the ROS parameter server, by the same reader that YAML files go
/// through.
namespace sightline::bridge {

/// Everything below the namespace of a node handle, as one document. Errors name the namespace as
/// their source.
config::Node parametersBelow(const ros::NodeHandle& node);

/// Throws config::Error. Keys that no field knows are left alone: other libraries keep parameters
/// there too.
template <class Config>
Config readParameters(const ros::NodeHandle& node) {
  Config config;
  config::read(parametersBelow(node), config, config::UnknownKeys::kIgnore);
  return config;
}

}  // namespace sightline::bridge
