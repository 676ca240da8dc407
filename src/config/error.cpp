#include "sightline/config/error.h"

namespace sightline::config {

namespace {

std::string describe(const std::string& source, int line, const std::string& key,
                     const std::string& reason) {
  std::string text;
  if (!source.empty()) text += source + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
  if (!key.empty()) text += key + ": ";
  return text + reason;
}

}  // namespace

Error::Error(const std::string& source, int line, const std::string& key, const std::string& reason)
    : std::runtime_error(describe(source, line, key, reason)),
      source_(source),
      line_(line),
      key_(key),
      reason_(reason) {}

}  // namespace sightline::config
