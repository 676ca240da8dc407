#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "sightline/config/fields.h"

namespace sightline::test {

/// A configuration with one setting at an end of its range.
template <class Config>
struct Limit {
  std::string name;  ///< as `gate.sigmas = 10`
  Config config;
};

/// Sets one setting to one end of its range: the one of that number, counted over the field list.
/// Ends are the bounds of numbers, of each number of a list and of each coordinate of a pose, both
/// values of flags, and every word of choices. Texts have none.
class EndSetter : public config::FieldVisitor {
 public:
  explicit EndSetter(int wanted) : left_(wanted) {}

  /// Name of the setting; empty where the field list has fewer ends.
  const std::string& name() const { return name_; }

 private:
  void member(const char* name, const config::Member& member, const config::Field& field) override {
    key_ = path_ + name;
    std::visit([&](const auto& kind) { ends(kind, field.range); }, member);
  }
  void enter(const char* group) override { path_ += std::string(group) + "."; }
  void leave() override { path_.erase(path_.rfind('.', path_.size() - 2) + 1); }
  bool wants(const char*, bool present) override { return present; }
  std::vector<std::string> names(const std::vector<std::string>& present, const char*) override {
    return present;
  }

  template <class Number>
  void set(Number& number, double value) {
    if (left_-- != 0) return;
    number = static_cast<Number>(value);
    name_ = fmt::format("{} = {}", key_, value);
  }
  template <class Number>
  void ends(Number* number, const config::Range& range) {
    set(*number, range.min);
    set(*number, range.max);
  }
  void ends(bool* flag, const config::Range&) {
    set(*flag, 0.0);
    set(*flag, 1.0);
  }
  void ends(const config::Choice& choice, const config::Range&) {
    for (std::size_t i = 0; i < choice.options->size(); ++i) set(*choice.index, i);
  }
  void ends(std::vector<double>* numbers, const config::Range& range) {
    for (double& number : *numbers) ends(&number, range);
  }
  void ends(const config::FixedNumbers& numbers, const config::Range& range) {
    for (std::size_t i = 0; i < numbers.count; ++i) ends(numbers.first + i, range);
  }
  void ends(geometry::Pose2* pose, const config::Range& range) {
    Eigen::Vector3d coordinates = pose->coordinates();
    for (double& coordinate : coordinates) ends(&coordinate, range);
    *pose = geometry::Pose2(coordinates);
  }
  void ends(std::optional<geometry::Pose2>* pose, const config::Range& range) {
    if (*pose) ends(&**pose, range);
  }
  void ends(std::string*, const config::Range&) {}
  void ends(std::vector<std::string>*, const config::Range&) {}
  void ends(const config::PathText&, const config::Range&) {}

  int left_;
  std::string path_;
  std::string key_;
  std::string name_;
};

/// A configuration for each end of each setting, everything else as in the one given.
template <class Config>
std::vector<Limit<Config>> atBothEnds(const Config& config) {
  std::vector<Limit<Config>> limits;
  for (int i = 0;; ++i) {
    Limit<Config> limit{"", config};
    EndSetter setter(i);
    limit.config.visit(setter);
    if (setter.name().empty()) return limits;
    limit.name = setter.name();
    limits.push_back(limit);
  }
}

}  // namespace sightline::test
