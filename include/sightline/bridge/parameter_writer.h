#pragma once

#include <string>
#include <vector>

#include <ros/node_handle.h>

#include "sightline/config/fields.h"

namespace sightline::bridge {

/// Puts the fields of a configuration struct on the parameter server, where readParameters finds
/// them.
class ParameterWriter : public config::FieldVisitor {
 public:
  explicit ParameterWriter(const ros::NodeHandle& node) : node_(node) {}

  void number(const char* name, double& value, const config::Field& field) override;
  void integer(const char* name, int& value, const config::Field& field) override;
  void flag(const char* name, bool& value, const char* meaning) override;
  void text(const char* name, std::string& value, const char* meaning) override;
  void numbers(const char* name, std::vector<double>& values, const config::Field& field) override;
  void option(const char* name, std::size_t& index, const std::vector<const char*>& options,
              const char* meaning) override;
  void enter(const char* group) override { path_ += std::string(group) + "/"; }
  void leave() override { path_.erase(path_.rfind('/', path_.size() - 2) + 1); }

 private:
  ros::NodeHandle node_;
  std::string path_;  // of the group, with its slash
};

/// Below the namespace of a node handle.
template <class Config>
void writeParameters(const ros::NodeHandle& node, Config config) {
  ParameterWriter writer(node);
  config.visit(writer);
}

}  // namespace sightline::bridge
