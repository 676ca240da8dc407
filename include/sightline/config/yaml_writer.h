#pragma once

#include <string>

#include "sightline/config/fields.h"

namespace sightline::config {

/// A text as YAML reads it back, whatever it holds.
std::string yamlQuoted(const std::string& text);

namespace detail {
class YamlWriter : public FieldObserver {
 public:
  std::string yaml;

 private:
  void value(const char* name, const Value& value, const Field& field) override;
  void enter(const char* group) override;
  void leave() override { --depth_; }

  int depth_ = 0;
};
}  // namespace detail

/// All fields of a configuration as a YAML map, with unit and meaning on every line; config::read()
/// gives the same configuration back, to the last digit.
template <class Config>
std::string toYaml(const Config& config) {
  detail::YamlWriter writer;
  writer.observe(config);
  return writer.yaml;
}

}  // namespace sightline::config
