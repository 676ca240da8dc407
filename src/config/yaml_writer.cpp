#include "sightline/config/yaml_writer.h"

#include <fmt/format.h>

namespace sightline::config {

std::string yamlQuoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

namespace detail {

void YamlWriter::line(const char* name, const std::string& value, const std::string& comment) {
  const std::string entry = fmt::format("{:{}}{}: {}", "", 2 * depth_, name, value);
  yaml += fmt::format("{:<40} # {}\n", entry, comment);
}

void YamlWriter::number(const char* name, double& value, const Field& field) {
  line(name, fmt::format("{}", value), fmt::format("{}, {}", field.unit, field.meaning));
}

void YamlWriter::integer(const char* name, int& value, const Field& field) {
  line(name, fmt::format("{}", value), fmt::format("{}, {}", field.unit, field.meaning));
}

void YamlWriter::flag(const char* name, bool& value, const char* meaning) {
  line(name, value ? "true" : "false", meaning);
}

void YamlWriter::text(const char* name, std::string& value, const char* meaning) {
  line(name, yamlQuoted(value), meaning);
}

void YamlWriter::numbers(const char* name, std::vector<double>& values, const Field& field) {
  line(name, fmt::format("[{}]", fmt::join(values, ", ")),
       fmt::format("{}, {}", field.unit, field.meaning));
}

void YamlWriter::option(const char* name, std::size_t& index,
                        const std::vector<const char*>& options, const char* meaning) {
  line(name, options[index], meaning);
}

void YamlWriter::enter(const char* group) {
  yaml += fmt::format("{:{}}{}:\n", "", 2 * depth_, group);
  ++depth_;
}

}  // namespace detail

}  // namespace sightline::config
