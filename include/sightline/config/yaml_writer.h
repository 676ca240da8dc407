#pragma once

#include <string>
#include <vector>

#include "sightline/config/fields.h"

namespace sightline::config {

/// A text as YAML reads it back, whatever it holds.
std::string yamlQuoted(const std::string& text);

namespace detail {
class YamlWriter : public FieldVisitor {
 public:
  void number(const char* name, double& value, const Field& field) override;
  void integer(const char* name, int& value, const Field& field) override;
  void flag(const char* name, bool& value, const char* meaning) override;
  void text(const char* name, std::string& value, const char* meaning) override;
  void numbers(const char* name, std::vector<double>& values, const Field& field) override;
  void option(const char* name, std::size_t& index, const std::vector<const char*>& options,
              const char* meaning) override;
  void enter(const char* group) override;
  void leave() override { --depth_; }

  std::string yaml;

 private:
  void line(const char* name, const std::string& value, const std::string& comment);

  int depth_ = 0;
};
}  // namespace detail

/// All fields of a configuration as a YAML map, with unit and meaning on every line; config::read()
/// gives the same configuration back, to the last digit.
template <class Config>
std::string toYaml(Config config) {
  detail::YamlWriter writer;
  config.visit(writer);
  return writer.yaml;
}

}  // namespace sightline::config
