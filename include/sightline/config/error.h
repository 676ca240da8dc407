#pragma once

#include <stdexcept>
#include <string>

namespace sightline::config {

/// A setting or file that cannot be used. what() reads `SOURCE:LINE: KEY: REASON`, leaving out what
/// is unknown.
class Error : public std::runtime_error {
 public:
  /// `source` is a file or a parameter namespace; `line` counts from 1, 0 if unknown.
  Error(const std::string& source, int line, const std::string& key, const std::string& reason);

  const std::string& source() const { return source_; }
  int line() const { return line_; }
  const std::string& key() const { return key_; }
  const std::string& reason() const { return reason_; }

 private:
  std::string source_;
  int line_;
  std::string key_;
  std::string reason_;
};

}  // namespace sightline::config
