#pragma once

#include <string>

#include <ros/node_handle.h>

#include "sightline/config/fields.h"

namespace sightline::bridge {

/// Puts the fields of a configuration struct on the parameter server, where readParameters finds
/// them.
class ParameterWriter : public config::FieldObserver {
 public:
  explicit ParameterWriter(const ros::NodeHandle& node) : node_(node) {}

 private:
  void value(const char* name, const config::Value& value, const config::Field& field) override;
  void enter(const char* group) override { path_ += std::string(group) + "/"; }
  void leave() override { path_.erase(path_.rfind('/', path_.size() - 2) + 1); }

  ros::NodeHandle node_;
  std::string path_;  // of the group, with its slash
};

/// Below the namespace of a node handle.
template <class Config>
void writeParameters(const ros::NodeHandle& node, const Config& config) {
  ParameterWriter(node).observe(config);
}

}  // namespace sightline::bridge
