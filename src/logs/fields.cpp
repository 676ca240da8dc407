#include "sightline/logs/fields.h"

#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "sightline/config/error.h"

namespace sightline::logs {

namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
// Largest whole seconds of which the nanoseconds fit.
constexpr std::int64_t kMaxSeconds = std::numeric_limits<std::int64_t>::max() / kSecond - 1;

bool isBlank(char c) {
  return c == ' ' || c == '\t';
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

// Digits, and after a point more of them: the form in which stamps survive a reading to the last
// digit. Nothing in any other form.
std::optional<std::int64_t> parseDecimal(const char* text) {
  std::int64_t seconds = 0;
  std::int64_t fraction = 0;
  if (!isDigit(*text)) return std::nullopt;
  for (; isDigit(*text); ++text) {
    seconds = 10 * seconds + (*text - '0');
    if (seconds > kMaxSeconds) return std::nullopt;
  }
  if (*text == '.') ++text;
  for (std::int64_t unit = kSecond / 10; isDigit(*text); ++text, unit /= 10) {
    fraction += unit * (*text - '0');
  }
  if (*text != '\0') return std::nullopt;
  return seconds * kSecond + fraction;
}

}  // namespace

std::optional<std::int64_t> parseStamp(const std::string& text) {
  const bool negative = !text.empty() && text[0] == '-';
  if (const auto exact = parseDecimal(text.c_str() + (negative ? 1 : 0))) {
    return negative ? -*exact : *exact;
  }
  char* end = nullptr;
  const long double seconds = std::strtold(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0' || !(std::fabs(seconds) <= kMaxSeconds)) {
    return std::nullopt;
  }
  return std::llround(seconds * kSecond);
}

std::string formatStamp(std::int64_t nanoseconds) {
  const std::int64_t size = nanoseconds < 0 ? -nanoseconds : nanoseconds;
  return fmt::format("{}{}.{:09}", nanoseconds < 0 ? "-" : "", size / kSecond, size % kSecond);
}

Fields::Fields(const std::string& line, const std::string& source, int number)
    : source_(source), number_(number), position_(line.c_str()) {}

void Fields::skipBlanks() {
  while (isBlank(*position_)) ++position_;
}

bool Fields::atEnd() {
  skipBlanks();
  return *position_ == '\0';
}

std::string Fields::word(const char* name) {
  if (atEnd()) failAt(name, "");
  const char* begin = position_;
  while (*position_ != '\0' && !isBlank(*position_)) ++position_;
  return {begin, position_};
}

double Fields::number(const char* name) {
  if (atEnd()) failAt(name, "");
  char* end = nullptr;
  const double value = std::strtod(position_, &end);
  if (end == position_ || (*end != '\0' && !isBlank(*end))) failAt(name, "a number");
  position_ = end;
  return value;
}

double Fields::finite(const char* name) {
  const char* begin = position_;
  const double value = number(name);
  if (!std::isfinite(value)) {
    position_ = begin;
    failAt(name, "a finite number");
  }
  return value;
}

std::int64_t Fields::stamp(const char* name) {
  const std::string text = word(name);
  const auto stamp = parseStamp(text);
  if (!stamp) fail(fmt::format("{}: expected a time, found '{}'", name, text));
  return *stamp;
}

std::size_t Fields::count(const char* name, std::size_t most) {
  const std::string text = word(name);
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (*end != '\0' || value < 0 || static_cast<std::size_t>(value) > most) {
    fail(fmt::format("{}: expected a whole number from 0 to {}, found '{}'", name, most, text));
  }
  return static_cast<std::size_t>(value);
}

void Fields::fail(const std::string& reason) const {
  throw config::Error(source_, number_, key_, reason);
}

void Fields::failAt(const char* name, const std::string& expected) {
  if (atEnd()) fail(fmt::format("the line ends where {} should be", name));
  fail(fmt::format("{}: expected {}, found '{}'", name, expected, word(name)));
}

}  // namespace sightline::logs
