#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sightline/config/node.h"

/// Field lists: how a configuration struct says what it holds.
///
/// A struct keeps every default in its member initialiser and defines `void
/// visit(config::FieldVisitor&)`, which names each member once with unit, range, meaning and
/// source. Reading from YAML or from ROS parameters, checking, writing and documenting are visitors
/// over that one list.
namespace sightline::config {

struct Field {
  const char* unit;
  Range range;
  const char* meaning;  ///< one sentence, with the source equation where there is one
};

class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;
  virtual void number(const char* name, double& value, const Field& field) = 0;
  virtual void integer(const char* name, int& value, const Field& field) = 0;
  virtual void flag(const char* name, bool& value, const char* meaning) = 0;
  virtual void text(const char* name, std::string& value, const char* meaning) = 0;
  virtual void numbers(const char* name, std::vector<double>& values, const Field& field) = 0;
  virtual void option(const char* name, std::size_t& index, const std::vector<const char*>& options,
                      const char* meaning) = 0;
  virtual void enter(const char* group) = 0;
  virtual void leave() = 0;

  /// A nested configuration struct.
  template <class Config>
  void group(const char* name, Config& config) {
    enter(name);
    config.visit(*this);
    leave();
  }

  /// An enumeration whose enumerators count from zero in the order of the names.
  template <class Enum>
  void choice(const char* name, Enum& value, const std::vector<const char*>& options,
              const char* meaning) {
    auto index = static_cast<std::size_t>(value);
    option(name, index, options, meaning);
    value = static_cast<Enum>(index);
  }
};

/// What a document may hold beyond the fields.
enum class UnknownKeys { kRefuse, kIgnore };

namespace detail {
class Reader : public FieldVisitor {
 public:
  Reader(const Node& node, UnknownKeys unknown);
  void number(const char* name, double& value, const Field& field) override;
  void integer(const char* name, int& value, const Field& field) override;
  void flag(const char* name, bool& value, const char* meaning) override;
  void text(const char* name, std::string& value, const char* meaning) override;
  void numbers(const char* name, std::vector<double>& values, const Field& field) override;
  void option(const char* name, std::size_t& index, const std::vector<const char*>& options,
              const char* meaning) override;
  void enter(const char* group) override;
  void leave() override;
  /// To be called once every field has been visited.
  void finish();

 private:
  struct Level {
    Node node;
    bool present;
    std::vector<std::string> known;
  };
  bool take(const char* name);
  void refuseUnknown(const Level& level) const;

  UnknownKeys unknown_;
  std::vector<Level> levels_;
};

class Validator : public FieldVisitor {
 public:
  explicit Validator(std::string source) : source_(std::move(source)) {}
  void number(const char* name, double& value, const Field& field) override;
  void integer(const char* name, int& value, const Field& field) override;
  void flag(const char*, bool&, const char*) override {}
  void text(const char*, std::string&, const char*) override {}
  void numbers(const char* name, std::vector<double>& values, const Field& field) override;
  void option(const char*, std::size_t&, const std::vector<const char*>&, const char*) override {}
  void enter(const char* group) override { path_.emplace_back(group); }
  void leave() override { path_.pop_back(); }

 private:
  void check(const char* name, double value, const Field& field) const;

  std::string source_;
  std::vector<std::string> path_;
};
}  // namespace detail

/// Overwrites the fields that the document names; the others keep what they hold. Throws Error.
template <class Config>
void read(const Node& node, Config& config, UnknownKeys unknown = UnknownKeys::kRefuse) {
  detail::Reader reader(node, unknown);
  config.visit(reader);
  reader.finish();
}

/// Throws Error with the key, the value and the allowed range of the first field that is outside
/// its range.
template <class Config>
void validate(const Config& config, const std::string& source = "") {
  detail::Validator validator(source);
  auto copy = config;  // visitors may write
  copy.visit(validator);
}

/// One row of the documentation of a struct.
struct FieldDescription {
  std::string key;  ///< dotted, from the outermost struct
  std::string type;
  std::string default_value;
  std::string unit;
  std::string range;
  std::string meaning;
};

namespace detail {
class Describer : public FieldVisitor {
 public:
  void number(const char* name, double& value, const Field& field) override;
  void integer(const char* name, int& value, const Field& field) override;
  void flag(const char* name, bool& value, const char* meaning) override;
  void text(const char* name, std::string& value, const char* meaning) override;
  void numbers(const char* name, std::vector<double>& values, const Field& field) override;
  void option(const char* name, std::size_t& index, const std::vector<const char*>& options,
              const char* meaning) override;
  void enter(const char* group) override { path_.emplace_back(group); }
  void leave() override { path_.pop_back(); }

  std::vector<FieldDescription> rows;

 private:
  std::string keyOf(const char* name) const;

  std::vector<std::string> path_;
};
}  // namespace detail

template <class Config>
std::vector<FieldDescription> describe(Config config = {}) {
  detail::Describer describer;
  config.visit(describer);
  return describer.rows;
}

}  // namespace sightline::config
