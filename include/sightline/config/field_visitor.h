#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sightline/config/range.h"
#include "sightline/geometry/pose2.h"

/// Field lists: how a configuration struct says what it holds.
///
/// A struct keeps every default in its member initialiser and defines `void
/// visit(config::FieldVisitor&)`, which names each member once with unit, range, meaning and
/// source. Reading from YAML or from ROS parameters, checking, writing and documenting are visitors
/// over that one list.
namespace sightline::config {

struct Field {
  const char* unit;  ///< "-" where there is none
  Range range;
  const char* meaning;  ///< one sentence, with the source equation where there is one
};

/// A text that names a file.
struct PathText {
  std::string* text;
};
/// One of several words, counted from zero.
struct Choice {
  std::size_t* index;
  const std::vector<const char*>* options;
};
/// A list of numbers whose length is given.
struct FixedNumbers {
  double* first;
  std::size_t count;
};

/// A member of a struct, as its field list hands it to a visitor: one alternative for each kind of
/// setting. A new kind is an alternative here, a way to read it (Reader), its values (valueOf) and
/// its name in the documentation (Describer); whatever else visits stays as it is.
using Member = std::variant<double*, int*, bool*, std::string*, PathText, Choice,
                            std::vector<double>*, FixedNumbers, std::vector<std::string>*,
                            geometry::Pose2*, std::optional<geometry::Pose2>*>;

/// x and y of a pose [m], and its yaw [rad].
constexpr Range kCoordinate{-1e5, 1e5};

/// A direction in a plane, either way round [rad].
constexpr Range kDirection{-6.2832, 6.2832};

class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;
  virtual void member(const char* name, const Member& member, const Field& field) = 0;
  virtual void enter(const char* group) = 0;
  virtual void leave() = 0;
  /// Whether an optional group is visited: one that is not `present` comes into being.
  virtual bool wants(const char* group, bool present) = 0;
  /// The names to visit in the map that was entered last; those not `present` come into being.
  virtual std::vector<std::string> names(const std::vector<std::string>& present,
                                         const char* meaning) = 0;

  void number(const char* name, double& value, const Field& field) { member(name, &value, field); }
  void integer(const char* name, int& value, const Field& field) { member(name, &value, field); }
  void flag(const char* name, bool& value, const char* meaning) {
    member(name, &value, {"-", {}, meaning});
  }
  void text(const char* name, std::string& value, const char* meaning) {
    member(name, &value, {"-", {}, meaning});
  }
  /// A list of texts; one text with the items apart by commas or blanks is taken for one, too.
  void texts(const char* name, std::vector<std::string>& values, const char* meaning) {
    member(name, &values, {"-", {}, meaning});
  }
  /// The path of a file, relative to the folder of the file that names it (Node::path).
  void path(const char* name, std::string& value, const char* meaning) {
    member(name, PathText{&value}, {"-", {}, meaning});
  }
  /// A list of numbers of any length.
  void numbers(const char* name, std::vector<double>& values, const Field& field) {
    member(name, &values, field);
  }
  /// A list of exactly N numbers.
  template <std::size_t N>
  void numbers(const char* name, std::array<double, N>& values, const Field& field) {
    member(name, FixedNumbers{values.data(), N}, field);
  }
  /// [x, y, yaw] [m, m, rad]; an optional one may be empty, [].
  void pose(const char* name, geometry::Pose2& pose, const char* meaning) {
    member(name, &pose, {"m, m, rad", kCoordinate, meaning});
  }
  void pose(const char* name, std::optional<geometry::Pose2>& pose, const char* meaning) {
    member(name, &pose, {"m, m, rad", kCoordinate, meaning});
  }
  void option(const char* name, std::size_t& index, const std::vector<const char*>& options,
              const char* meaning) {
    member(name, Choice{&index, &options}, {"-", {}, meaning});
  }

  /// An enumeration whose enumerators count from zero in the order of the names.
  template <class Enum>
  void choice(const char* name, Enum& value, const std::vector<const char*>& options,
              const char* meaning) {
    const auto before = static_cast<std::size_t>(value);
    auto index = before;
    option(name, index, options, meaning);
    if (index != before) value = static_cast<Enum>(index);
  }

  /// A nested configuration struct.
  template <class Config>
  void group(const char* name, Config& config) {
    enter(name);
    config.visit(*this);
    leave();
  }
  /// One that is there only where the document has its key.
  template <class Config>
  void group(const char* name, std::optional<Config>& config) {
    if (!wants(name, config.has_value())) return;
    if (!config) config.emplace();
    group(name, *config);
  }

  /// Poses, lists of angles [rad] or configuration structs by names that the document chooses.
  template <class Value>
  void entries(const char* name, std::map<std::string, Value>& values, const char* meaning) {
    std::vector<std::string> present;
    for (const auto& [key, value] : values) present.push_back(key);
    enter(name);
    for (const std::string& key : names(present, meaning)) entry(key.c_str(), values[key], meaning);
    leave();
  }

 private:
  void entry(const char* name, geometry::Pose2& value, const char* meaning) {
    pose(name, value, meaning);
  }
  void entry(const char* name, std::vector<double>& value, const char* meaning) {
    numbers(name, value, {"rad", kDirection, meaning});
  }
  template <class Config>
  void entry(const char* name, Config& value, const char*) {
    group(name, value);
  }
};

/// Value of a member. Paths and choices are texts, poses are x, y and yaw, a pose that is not there
/// is an empty list.
using Value =
    std::variant<double, int, bool, std::string, std::vector<double>, std::vector<std::string>>;
Value valueOf(const Member& member);

/// A visitor that only looks: it is handed values in place of members, and neither groups nor
/// entries come into being under it.
///
/// visit() is not const, as one list serves readers and writers. So this class is the one place
/// that takes the const away; copying the struct instead would cost every check a copy, and a
/// second, const list would be one to forget a member in.
class FieldObserver : private FieldVisitor {
 public:
  template <class Config>
  void observe(const Config& config) {
    const_cast<Config&>(config).visit(*this);
  }

 protected:
  virtual void value(const char* name, const Value& value, const Field& field) = 0;
  void enter(const char*) override {}
  void leave() override {}

 private:
  void member(const char* name, const Member& member, const Field& field) final {
    value(name, valueOf(member), field);
  }
  bool wants(const char*, bool present) final { return present; }
  std::vector<std::string> names(const std::vector<std::string>& present, const char*) final {
    return present;
  }
};

}  // namespace sightline::config
