#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sightline::tools {

/// A command line that cannot be used.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A program of the command line: what it takes is declared first, then it runs. Values keep what
/// they hold where the command line says nothing; they have to outlive run(). Numbers are finite.
/// No option may be given twice.
class Program {
 public:
  Program(const std::string& name, const std::string& purpose);
  ~Program();

  /// The next word that belongs to no option; it may not be left out.
  void positional(const std::string& name, std::string& value, const std::string& meaning);
  /// Adds an argument that may be left out.
  void positional(const std::string& name, std::optional<std::string>& value,
                  const std::string& meaning);
  enum class Fewest { kNone, kOne };
  /// All further words that belong to no option.
  void positionals(const std::string& name, std::vector<std::string>& values,
                   const std::string& meaning, Fewest fewest = Fewest::kOne);
  /// An option without a value: true where it is given.
  void flag(const std::string& name, bool& value, const std::string& meaning);

  /// Options with a value; `unit` stands for the value in the help.
  void option(const std::string& name, double& value, const std::string& unit,
              const std::string& meaning);
  /// A whole number, 0 or more, in decimal digits.
  void option(const std::string& name, std::uint64_t& value, const std::string& unit,
              const std::string& meaning);
  void option(const std::string& name, std::optional<std::uint64_t>& value, const std::string& unit,
              const std::string& meaning);
  void option(const std::string& name, std::array<double, 3>& values, const std::string& units,
              const std::string& meaning);
  void option(const std::string& name, std::optional<std::string>& value, const std::string& unit,
              const std::string& meaning);
  /// May not be left out.
  void requiredOption(const std::string& name, std::string& value, const std::string& unit,
                      const std::string& meaning);

  /// Reads the command line, then runs `body`. Returns the exit status: that of `body`; 0 after the
  /// help that --help asks for; 2 with the reason and the usage for a command line that cannot be
  /// used, also where `body` throws UsageError; 1 with the reason for any other exception.
  int run(int argc, const char* const* argv, const std::function<int()>& body);

 private:
  int refuse(const std::string& reason) const;

  // CLI11 stays out of this header: it takes seconds to compile.
  std::unique_ptr<CLI::App> app_;
};

}  // namespace sightline::tools
