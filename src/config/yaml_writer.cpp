#include "sightline/config/yaml_writer.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace sightline::config {

namespace {

struct YamlText {
  template <class Item>
  std::string operator()(const Item& item) const {
    return fmt::format("{}", item);
  }
  std::string operator()(const std::string& text) const { return yamlQuoted(text); }
  template <class Item>
  std::string operator()(const std::vector<Item>& items) const {
    std::string list;
    for (const Item& item : items) list += (list.empty() ? "" : ", ") + (*this)(item);
    return "[" + list + "]";
  }
};

// A name of a map, which may be any text, as a key.
std::string yamlKey(const std::string& name) {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_';
  });
  return plain ? name : yamlQuoted(name);
}

}  // namespace

std::string yamlQuoted(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << text;
  return emitter.c_str();
}

namespace detail {

void YamlWriter::value(const char* name, const Value& value, const Field& field) {
  const std::string indent(2 * depth_, ' ');
  const std::string entry = indent + yamlKey(name) + ": " + std::visit(YamlText(), value);
  const std::string unit = field.unit == std::string("-") ? "" : fmt::format("{}, ", field.unit);
  yaml += fmt::format("{:<40} # {}{}\n", entry, unit, field.meaning);
}

void YamlWriter::enter(const char* group) {
  yaml += std::string(2 * depth_, ' ') + yamlKey(group) + ":\n";
  ++depth_;
}

}  // namespace detail

}  // namespace sightline::config
