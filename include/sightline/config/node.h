#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "sightline/config/error.h"
#include "sightline/config/range.h"
#include "sightline/geometry/pose2.h"

namespace sightline::config {

/// A place in a YAML document that knows its file and key, so that whatever is wrong there can be
/// said in full. Every accessor throws Error with file, line, key and the reason; a key that stands
/// twice in one map is an error too.
class Node {
 public:
  /// Something that was not read from a file, such as parameters.
  Node(YAML::Node yaml, std::string source, std::string key = "");
  Node(const Node&) = default;
  /// Makes this another place; YAML::Node would write the other's value into this one's document.
  Node& operator=(const Node& other);

  /// A file or text of one YAML document; an empty one is null.
  static Node readFile(const std::string& path);
  static Node parse(const std::string& text, const std::string& source);

  bool isMap() const;
  /// True where nothing is written: an empty document, or a key without a value.
  bool isNull() const;
  /// True where nothing is written, or an empty text or an empty sequence.
  bool isEmpty() const;
  bool has(const std::string& key) const;
  /// The value of a key that has to be there.
  Node at(const std::string& key) const;
  /// All entries of a map, in the order of the file.
  std::vector<std::pair<std::string, Node>> entries() const;
  /// All items of a sequence; throws where there is none, so ask has() before reading an optional
  /// one. A text in brackets, '[0, 0, 0]', is a sequence too: command lines and launch
  /// files cannot say it otherwise.
  std::vector<Node> items() const;
  /// Refuses any key that is not listed: a typing error must not pass for a default.
  void allowOnly(std::initializer_list<const char*> keys) const;

  /// Never NaN; finite unless the range is infinite on that side.
  double number(Range range = {}) const;
  int integer(Range range = {}) const;
  /// true, false, and what YAML takes for them, or 1 and 0.
  bool flag() const;
  std::string text() const;
  /// The index of a text in a list of words.
  std::size_t choice(const std::vector<const char*>& words) const;
  /// A sequence of texts, or one text with its items apart by commas or blanks.
  std::vector<std::string> texts() const;
  /// A sequence of finite numbers.
  std::vector<double> numbers(Range range = {}) const;
  /// The same, of exactly `count` numbers.
  std::vector<double> numbers(std::size_t count, Range range = {}) const;
  /// [x, y, yaw] [m, m, rad]; a yaw of more than a turn is refused, as it is in degrees.
  geometry::Pose2 pose(Range range = {}) const;

  double numberOr(const std::string& key, double fallback, Range range = {}) const;
  std::string textOr(const std::string& key, const std::string& fallback) const;

  [[noreturn]] void fail(const std::string& reason) const;

  const std::string& source() const { return source_; }
  const std::string& key() const { return key_; }
  /// A path written here. It is relative to the folder of the file that it is written in, or, where
  /// that is no file, to the working directory; ~ is the home of the user; an empty one stays
  /// empty.
  std::string path() const;

 private:
  template <class T>
  T as(const char* expected) const;
  Node child(const std::string& key, const YAML::Node& value) const;
  Node place(const std::string& key, const YAML::Node& value) const;
  bool isList() const;
  Node sequence() const;
  int line() const;

  YAML::Node yaml_;
  std::string source_;
  std::string key_;
  std::string folder_;  // of the file, empty where there is none
  int line_ = 0;        // of the text that a sequence was read from, 0 where it was none
};

}  // namespace sightline::config
