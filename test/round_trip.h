#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "sightline/config/fields.h"

namespace sightline::test {

/// Gives every setting a value within its range that it did not hold, and groups and entries that
/// were missing. No two settings of one kind and range get the same, so that a pair that was mixed
/// up shows.
class ChangeEverything : public config::FieldVisitor {
 private:
  void member(const char*, const config::Member& member, const config::Field& field) override {
    ++count_;
    std::visit([&](const auto& kind) { change(kind, field.range); }, member);
  }
  void enter(const char*) override {}
  void leave() override {}
  bool wants(const char*, bool) override { return true; }
  std::vector<std::string> names(const std::vector<std::string>& present, const char*) override {
    auto names = present;
    names.insert(names.end(), {"first", "second"});
    return names;
  }

  // Spread over the range by the golden ratio: far from each other, and from round defaults.
  double share() const { return std::fmod(0.6180339887498949 * count_, 1.0); }
  double within(const config::Range& range) const {
    return range.min + share() * (range.max - range.min);
  }

  void change(double* number, const config::Range& range) { *number = within(range); }
  void change(int* number, const config::Range& range) {
    const int old = *number;
    *number = static_cast<int>(within(range));
    if (*number == old) *number += range.contains(old + 1) ? 1 : -1;
  }
  void change(bool* flag, const config::Range&) { *flag = !*flag; }
  void change(std::string* text, const config::Range&) {
    *text = fmt::format("\"no. {}\": [#\n\t\\", count_);
  }
  void change(const config::PathText& path, const config::Range&) {
    *path.text = fmt::format("folder/no {}.yaml", count_);
  }
  void change(const config::Choice& choice, const config::Range&) {
    *choice.index = (*choice.index + 1) % choice.options->size();
  }
  void change(std::vector<double>* numbers, const config::Range& range) {
    *numbers = {within(range), range.min, range.max};
  }
  void change(const config::FixedNumbers& numbers, const config::Range& range) {
    for (std::size_t i = 0; i < numbers.count; ++i, ++count_) numbers.first[i] = within(range);
  }
  void change(std::vector<std::string>* texts, const config::Range&) {
    *texts = {fmt::format("no, {}", count_), "", "[x]"};
  }
  void change(geometry::Pose2* pose, const config::Range& range) {
    *pose = {within(range), -within(range), 3.0 * share()};
  }
  void change(std::optional<geometry::Pose2>* pose, const config::Range& range) {
    change(&pose->emplace(), range);
  }

  int count_ = 0;
};

template <class Config>
Config changed(Config config) {
  ChangeEverything change;
  config.visit(change);
  return config;
}

/// All settings by their dotted names.
class Settings : public config::FieldObserver {
 public:
  std::map<std::string, config::Value> values;

 private:
  void value(const char* name, const config::Value& value, const config::Field&) override {
    values[path_ + name] = value;
  }
  void enter(const char* group) override { path_ += std::string(group) + "."; }
  void leave() override { path_.erase(path_.rfind('.', path_.size() - 2) + 1); }

  std::string path_;
};

template <class Config>
std::map<std::string, config::Value> settingsOf(const Config& config) {
  Settings settings;
  settings.observe(config);
  return settings.values;
}

}  // namespace sightline::test
