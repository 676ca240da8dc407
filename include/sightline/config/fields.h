#pragma once

#include <string>
#include <vector>

#include "sightline/config/field_visitor.h"
#include "sightline/config/node.h"

/// Uses of field lists: reading, checking, documenting (writing: yaml_writer.h).
namespace sightline::config {

/// Treatment of keys of a document that are not fields.
enum class UnknownKeys { kRefuse, kIgnore };

namespace detail {
class Reader : public FieldVisitor {
 public:
  Reader(const Node& node, UnknownKeys unknown);
  void member(const char* name, const Member& member, const Field& field) override;
  void enter(const char* group) override;
  void leave() override;
  bool wants(const char* group, bool present) override;
  std::vector<std::string> names(const std::vector<std::string>& present,
                                 const char* meaning) override;
  /// Ends the visit; call it after every field has been visited.
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

class Validator : public FieldObserver {
 public:
  explicit Validator(std::string source) : source_(std::move(source)) {}

 private:
  void value(const char* name, const Value& value, const Field& field) override;
  void enter(const char* group) override { path_.emplace_back(group); }
  void leave() override { path_.pop_back(); }
  void check(const char* name, double number, const Field& field) const;

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
  detail::Validator(source).observe(config);
}

/// One row of the documentation of a struct.
struct FieldDescription {
  std::string key;  ///< dotted, from the outermost struct; NAME stands for a key of a map
  std::string type;
  std::string default_value;
  std::string unit;
  std::string range;
  std::string meaning;
};

namespace detail {
class Describer : public FieldVisitor {
 public:
  void member(const char* name, const Member& member, const Field& field) override;
  void enter(const char* group) override { path_.emplace_back(group); }
  void leave() override { path_.pop_back(); }
  bool wants(const char* group, bool present) override;
  std::vector<std::string> names(const std::vector<std::string>& present,
                                 const char* meaning) override;

  std::vector<FieldDescription> rows;

 private:
  std::vector<std::string> path_;
};
}  // namespace detail

/// All fields of a struct with the values that it holds, those of groups and entries that it might
/// hold, too.
template <class Config>
std::vector<FieldDescription> describe(Config config = {}) {
  detail::Describer describer;
  config.visit(describer);
  return describer.rows;
}

}  // namespace sightline::config
