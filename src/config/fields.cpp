#include "sightline/config/fields.h"

#include <algorithm>

#include <fmt/format.h>

namespace sightline::config {

namespace {

template <class List, class Item>
bool contains(const List& list, const Item& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

std::string dotted(const std::vector<std::string>& path, const char* name) {
  return path.empty() ? name : fmt::format("{}.{}", fmt::join(path, "."), name);
}

// Reads what stands at a node into a member.
struct FromNode {
  const Node& node;
  const Range& range;

  void operator()(double* number) const { *number = node.number(range); }
  void operator()(int* number) const { *number = node.integer(range); }
  void operator()(bool* flag) const { *flag = node.flag(); }
  void operator()(std::string* text) const { *text = node.text(); }
  void operator()(const PathText& path) const { *path.text = node.path(); }
  void operator()(const Choice& choice) const { *choice.index = node.choice(*choice.options); }
  void operator()(std::vector<double>* numbers) const { *numbers = node.numbers(range); }
  void operator()(const FixedNumbers& numbers) const {
    const auto values = node.numbers(numbers.count, range);
    std::copy(values.begin(), values.end(), numbers.first);
  }
  void operator()(std::vector<std::string>* texts) const { *texts = node.texts(); }
  void operator()(geometry::Pose2* pose) const { *pose = node.pose(range); }
  void operator()(std::optional<geometry::Pose2>* pose) const {
    pose->reset();
    if (!node.isEmpty()) *pose = node.pose(range);
  }
};

// Type and range of a member, in the words of the documentation.
struct Kind {
  std::string type;
  std::string range;
};

struct KindOf {
  const Range& range;

  Kind operator()(const double*) const { return {"double", range.text()}; }
  Kind operator()(const int*) const { return {"int", range.text()}; }
  Kind operator()(const bool*) const { return {"bool", "true, false"}; }
  Kind operator()(const std::string*) const { return {"string", "any"}; }
  Kind operator()(const PathText&) const { return {"path", "any"}; }
  Kind operator()(const Choice& choice) const {
    return {"choice", fmt::format("{}", fmt::join(*choice.options, ", "))};
  }
  Kind operator()(const std::vector<double>*) const { return {"list of double", range.text()}; }
  Kind operator()(const FixedNumbers& numbers) const {
    return {fmt::format("{} doubles", numbers.count), range.text()};
  }
  Kind operator()(const std::vector<std::string>*) const { return {"list of string", "any"}; }
  Kind operator()(const geometry::Pose2*) const { return {"pose", range.text()}; }
  Kind operator()(const std::optional<geometry::Pose2>*) const {
    return {"pose or []", range.text()};
  }
};

struct ValueText {
  template <class Item>
  std::string operator()(const Item& item) const {
    return fmt::format("{}", item);
  }
  template <class Item>
  std::string operator()(const std::vector<Item>& items) const {
    return fmt::format("[{}]", fmt::join(items, ", "));
  }
  std::string operator()(const std::string& text) const { return text.empty() ? "(empty)" : text; }
};

}  // namespace

namespace detail {

Reader::Reader(const Node& node, UnknownKeys unknown) : unknown_(unknown) {
  if (!node.isMap() && !node.isNull()) node.fail("expected a map");
  levels_.push_back({node, node.isMap(), {}});
}

bool Reader::take(const char* name) {
  Level& level = levels_.back();
  if (!contains(level.known, name)) level.known.emplace_back(name);
  return level.present && level.node.has(name);
}

void Reader::member(const char* name, const Member& member, const Field& field) {
  if (!take(name)) return;
  const Node node = levels_.back().node.at(name);
  std::visit(FromNode{node, field.range}, member);
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

bool Reader::wants(const char* group, bool present) {
  return take(group) || present;
}

std::vector<std::string> Reader::names(const std::vector<std::string>& present, const char*) {
  auto names = present;
  if (!levels_.back().present) return names;
  for (const auto& [name, node] : levels_.back().node.entries()) {
    if (!contains(names, name)) names.push_back(name);
  }
  return names;
}

void Reader::finish() {
  refuseUnknown(levels_.front());
}

void Reader::refuseUnknown(const Level& level) const {
  if (unknown_ == UnknownKeys::kIgnore || !level.present) return;
  for (const auto& [key, value] : level.node.entries()) {
    if (contains(level.known, key)) continue;
    value.fail(fmt::format("unknown key; known are: {}", fmt::join(level.known, ", ")));
  }
}

void Validator::check(const char* name, double number, const Field& field) const {
  if (field.range.contains(number)) return;
  throw Error(source_, 0, dotted(path_, name),
              fmt::format("{} is outside {}", number, field.range.text()));
}

void Validator::value(const char* name, const Value& value, const Field& field) {
  if (const auto* number = std::get_if<double>(&value)) check(name, *number, field);
  if (const auto* number = std::get_if<int>(&value)) check(name, *number, field);
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
    for (const double number : *numbers) check(name, number, field);
  }
}

void Describer::member(const char* name, const Member& member, const Field& field) {
  const Kind kind = std::visit(KindOf{field.range}, member);
  const std::string value = std::visit(ValueText(), valueOf(member));
  rows.push_back({dotted(path_, name), kind.type, value, field.unit, kind.range, field.meaning});
}

bool Describer::wants(const char*, bool) {
  return true;
}

std::vector<std::string> Describer::names(const std::vector<std::string>& present,
                                          const char* meaning) {
  rows.push_back({fmt::format("{}", fmt::join(path_, ".")), "map",
                  fmt::format("{{{}}}", fmt::join(present, ", ")), "-", "any names", meaning});
  return {"NAME"};
}

}  // namespace detail

}  // namespace sightline::config
