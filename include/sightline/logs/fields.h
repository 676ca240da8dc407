#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace sightline::logs {

/// A time written in seconds, as nanoseconds; exact where it is written without an exponent, to
/// the ninth decimal. Nothing if the text is not a number or no such time can be held.
std::optional<std::int64_t> parseStamp(const std::string& text);

/// Nanoseconds as seconds with nine decimals.
std::string formatStamp(std::int64_t nanoseconds);

/// The fields of one line of a log, separated by blanks, taken from left to right. Whatever is
/// wrong is thrown as config::Error with file, line and the kind of the line.
class Fields {
 public:
  /// The line has to outlive the fields.
  Fields(const std::string& line, const std::string& source, int number);

  /// Names the kind of the line in errors from here on.
  void setKey(const std::string& key) { key_ = key; }
  bool atEnd();
  /// `name` says what is missing or wrong.
  std::string word(const char* name);
  double number(const char* name);  ///< may be NaN or infinite
  double finite(const char* name);
  std::int64_t stamp(const char* name);  ///< [ns]
  /// A whole number from 0 to `most`.
  std::size_t count(const char* name, std::size_t most);

  [[noreturn]] void fail(const std::string& reason) const;

 private:
  void skipBlanks();
  [[noreturn]] void failAt(const char* name, const std::string& expected);

  std::string source_;
  int number_;
  std::string key_;
  const char* position_;
};

}  // namespace sightline::logs
