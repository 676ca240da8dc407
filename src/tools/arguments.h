#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sightline::tools {

/// A command line that cannot be used.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The words of a command line, taken away as they are asked for: options first, then the rest in
/// order. Throws UsageError.
class Arguments {
 public:
  Arguments(int argc, char** argv) : words_(argv + 1, argv + argc) {}

  bool flag(const std::string& name) { return take(name, 0).has_value(); }

  std::optional<std::string> text(const std::string& name) {
    const auto values = take(name, 1);
    if (!values) return std::nullopt;
    return values->front();
  }

  std::optional<std::vector<double>> numbers(const std::string& name, std::size_t count) {
    const auto values = take(name, count);
    if (!values) return std::nullopt;
    std::vector<double> numbers;
    for (const std::string& value : *values) numbers.push_back(numberOf(name, value));
    return numbers;
  }

  double number(const std::string& name, double fallback) {
    const auto value = numbers(name, 1);
    return value ? value->front() : fallback;
  }

  /// The next word that belongs to no option; `name` says what it is.
  std::string positional(const std::string& name) {
    if (words_.empty() || words_.front().rfind("--", 0) == 0) {
      throw UsageError(name + " is missing");
    }
    const std::string word = words_.front();
    words_.erase(words_.begin());
    return word;
  }

  /// To be called once everything has been asked for.
  void finish() const {
    if (!words_.empty()) throw UsageError("not understood: " + words_.front());
  }

 private:
  static double numberOf(const std::string& name, const std::string& text) {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(number)) {
      throw UsageError(name + " needs a number, not '" + text + "'");
    }
    return number;
  }

  // The values that follow an option, both removed from the words.
  std::optional<std::vector<std::string>> take(const std::string& name, std::size_t count) {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (words_[i] != name) continue;
      const auto option = words_.begin() + static_cast<std::ptrdiff_t>(i);
      if (words_.size() - i - 1 < count) throw UsageError(name + " needs a value");
      const auto end = option + static_cast<std::ptrdiff_t>(count) + 1;
      std::vector<std::string> values(option + 1, end);
      words_.erase(option, end);
      return values;
    }
    return std::nullopt;
  }

  std::vector<std::string> words_;
};

/// Runs a program on its arguments. Returns what it returns; 2 and the usage on a command line that
/// cannot be used; 1 and the reason on any other exception.
template <class Program>
int run(int argc, char** argv, const char* usage, const Program& program) {
  Arguments arguments(argc, argv);
  try {
    if (arguments.flag("--help")) {
      std::printf("usage: %s", usage);
      return 0;
    }
    return program(arguments);
  } catch (const UsageError& error) {
    std::fprintf(stderr, "%s\nusage: %s", error.what(), usage);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace sightline::tools
