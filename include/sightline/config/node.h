#pragma once

#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "sightline/config/error.h"

namespace sightline::config {

/// Bounds that a number has to keep, both included.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();

  bool contains(double value) const { return value >= min && value <= max; }
  /// As it reads in messages and tables: `[0, 1]`, `> 0`, `>= 0`, `any`.
  std::string text() const;
};
constexpr Range kPositive{std::numeric_limits<double>::min(), std::numeric_limits<double>::max()};
constexpr Range kNotNegative{0.0, std::numeric_limits<double>::max()};

/// A place in a YAML document that knows its file and key, so that whatever is wrong there can be
/// said in full. Every accessor throws Error with file, line, key and the reason; a key that stands
/// twice in one map is an error too.
class Node {
 public:
  Node(YAML::Node yaml, std::string source, std::string key = "");
  Node(const Node&) = default;
  /// Makes this another place; YAML::Node would write the other's value into this one's document.
  Node& operator=(const Node& other);

  /// A file or text of one YAML document; an empty one is null.
  static Node readFile(const std::string& path);
  static Node parse(const std::string& text, const std::string& source);

  bool isMap() const;
  /// Nothing written: an empty document, or a key without a value.
  bool isNull() const;
  bool has(const std::string& key) const;
  /// The value of a key that has to be there.
  Node at(const std::string& key) const;
  /// All entries of a map, in the order of the file.
  std::vector<std::pair<std::string, Node>> entries() const;
  /// All items of a sequence; an absent or empty optional sequence is `{}` where the caller asks
  /// has() first.
  std::vector<Node> items() const;
  /// Refuses any key that is not listed: a typing error must not pass for a default.
  void allowOnly(std::initializer_list<const char*> keys) const;

  /// Never NaN; finite unless the range is infinite on that side.
  double number(Range range = {}) const;
  int integer(Range range = {}) const;
  bool flag() const;
  std::string text() const;
  /// A sequence of finite numbers.
  std::vector<double> numbers(Range range = {}) const;
  /// As above, of exactly `count` numbers.
  std::vector<double> numbers(std::size_t count, Range range = {}) const;

  double numberOr(const std::string& key, double fallback, Range range = {}) const;
  std::string textOr(const std::string& key, const std::string& fallback) const;

  [[noreturn]] void fail(const std::string& reason) const;

  const std::string& source() const { return source_; }
  const std::string& key() const { return key_; }
  /// A path written in this document, taken relative to the document's own folder.
  std::string path() const;

 private:
  template <class T>
  T as(const char* expected) const;
  Node child(const std::string& key, const YAML::Node& value) const;

  YAML::Node yaml_;
  std::string source_;
  std::string key_;
};

}  // namespace sightline::config
