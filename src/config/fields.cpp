#include "sightline/config/fields.h"

#include <algorithm>

#include <fmt/format.h>

namespace sightline::config {

namespace {

std::string dotted(const std::vector<std::string>& path, const char* name) {
  return path.empty() ? name : fmt::format("{}.{}", fmt::join(path, "."), name);
}

}  // namespace

namespace detail {

Reader::Reader(const Node& node, UnknownKeys unknown) : unknown_(unknown) {
  if (!node.isMap() && !node.isNull()) node.fail("expected a map");
  levels_.push_back({node, node.isMap(), {}});
}

bool Reader::take(const char* name) {
  Level& level = levels_.back();
  level.known.emplace_back(name);
  return level.present && level.node.has(name);
}

void Reader::number(const char* name, double& value, const Field& field) {
  if (take(name)) value = levels_.back().node.at(name).number(field.range);
}

void Reader::integer(const char* name, int& value, const Field& field) {
  if (take(name)) value = levels_.back().node.at(name).integer(field.range);
}

void Reader::flag(const char* name, bool& value, const char*) {
  if (take(name)) value = levels_.back().node.at(name).flag();
}

void Reader::text(const char* name, std::string& value, const char*) {
  if (take(name)) value = levels_.back().node.at(name).text();
}

void Reader::numbers(const char* name, std::vector<double>& values, const Field& field) {
  if (!take(name)) return;
  values.clear();
  for (const Node& item : levels_.back().node.at(name).items()) {
    values.push_back(item.number(field.range));
  }
}

void Reader::option(const char* name, std::size_t& index, const std::vector<const char*>& options,
                    const char*) {
  if (!take(name)) return;
  const Node node = levels_.back().node.at(name);
  const std::string chosen = node.text();
  const auto found = std::find(options.begin(), options.end(), chosen);
  if (found == options.end()) {
    node.fail(fmt::format("'{}' is none of: {}", chosen, fmt::join(options, ", ")));
  }
  index = static_cast<std::size_t>(found - options.begin());
}

void Reader::enter(const char* group) {
  const bool present = take(group);
  const Node& outer = levels_.back().node;
  const Node inner = present ? outer.at(group) : outer;
  if (present && !inner.isMap() && !inner.isNull()) inner.fail("expected a map");
  levels_.push_back({inner, present && inner.isMap(), {}});
}

void Reader::leave() {
  refuseUnknown(levels_.back());
  levels_.pop_back();
}

void Reader::finish() {
  refuseUnknown(levels_.front());
}

void Reader::refuseUnknown(const Level& level) const {
  if (unknown_ == UnknownKeys::kIgnore || !level.present) return;
  for (const auto& [key, value] : level.node.entries()) {
    if (std::find(level.known.begin(), level.known.end(), key) == level.known.end()) {
      value.fail(fmt::format("unknown key; known are: {}", fmt::join(level.known, ", ")));
    }
  }
}

void Validator::check(const char* name, double value, const Field& field) const {
  if (field.range.contains(value)) return;
  throw Error(source_, 0, dotted(path_, name),
              fmt::format("{} is outside {}", value, field.range.text()));
}

void Validator::number(const char* name, double& value, const Field& field) {
  check(name, value, field);
}

void Validator::integer(const char* name, int& value, const Field& field) {
  check(name, value, field);
}

void Validator::numbers(const char* name, std::vector<double>& values, const Field& field) {
  for (const double value : values) check(name, value, field);
}

std::string Describer::keyOf(const char* name) const {
  return dotted(path_, name);
}

void Describer::number(const char* name, double& value, const Field& field) {
  rows.push_back({keyOf(name), "double", fmt::format("{}", value), field.unit, field.range.text(),
                  field.meaning});
}

void Describer::integer(const char* name, int& value, const Field& field) {
  rows.push_back({keyOf(name), "int", fmt::format("{}", value), field.unit, field.range.text(),
                  field.meaning});
}

void Describer::flag(const char* name, bool& value, const char* meaning) {
  rows.push_back({keyOf(name), "bool", value ? "true" : "false", "-", "true, false", meaning});
}

void Describer::text(const char* name, std::string& value, const char* meaning) {
  rows.push_back({keyOf(name), "string", value.empty() ? "(empty)" : value, "-", "any", meaning});
}

void Describer::numbers(const char* name, std::vector<double>& values, const Field& field) {
  rows.push_back({keyOf(name), "list of double", fmt::format("[{}]", fmt::join(values, ", ")),
                  field.unit, field.range.text(), field.meaning});
}

void Describer::option(const char* name, std::size_t& index,
                       const std::vector<const char*>& options, const char* meaning) {
  rows.push_back({keyOf(name), "choice", options[index], "-",
                  fmt::format("{}", fmt::join(options, ", ")), meaning});
}

}  // namespace detail

}  // namespace sightline::config
