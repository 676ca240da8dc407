#include "program.h"

#include <charconv>
#include <cmath>
#include <cstdio>

#include <CLI/CLI.hpp>

namespace sightline::tools {
namespace {

// CLI11 by itself takes inf and nan for numbers, and an empty word for 0.
std::string faultOfNumber(const std::string& text) {
  double number = 0.0;
  if (CLI::detail::lexical_cast(text, number) && std::isfinite(number)) return "";
  return "needs a number, not '" + text + "'";
}

std::optional<std::uint64_t> wholeNumber(const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return number;
}

std::string faultOfWholeNumber(const std::string& text) {
  return wholeNumber(text) ? "" : "needs a whole number, not '" + text + "'";
}

}  // namespace

Program::Program(const std::string& name, const std::string& purpose)
    : app_(std::make_unique<CLI::App>(purpose, name)) {
  app_->get_formatter()->label("Usage", "usage");
  // Replaces CLI11's own flag, which comes after the faults of the words around it.
  app_->set_help_flag();
  app_->add_flag_callback(
          "-h,--help", [] { throw CLI::CallForHelp(); }, "print this and end")
      ->trigger_on_parse();
}

Program::~Program() = default;

void Program::positional(const std::string& name, std::string& value, const std::string& meaning) {
  // The name says it all: neither type nor REQUIRED in the help.
  app_->add_option(name, value, meaning)->required()->option_text(" ");
}

void Program::positional(const std::string& name, std::optional<std::string>& value,
                         const std::string& meaning) {
  const auto set = [&value](const std::string& text) { value = text; };
  app_->add_option_function<std::string>(name, set, meaning)->option_text(" ");
}

void Program::positionals(const std::string& name, std::vector<std::string>& values,
                          const std::string& meaning, Fewest fewest) {
  app_->add_option(name, values, meaning)->required(fewest == Fewest::kOne)->option_text(" ");
}

void Program::flag(const std::string& name, bool& value, const std::string& meaning) {
  app_->add_flag(name, value, meaning)->multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

void Program::option(const std::string& name, double& value, const std::string& unit,
                     const std::string& meaning) {
  app_->add_option(name, value, meaning)->check(faultOfNumber)->type_name(unit);
}

void Program::option(const std::string& name, std::uint64_t& value, const std::string& unit,
                     const std::string& meaning) {
  const auto set = [&value](const std::string& text) { value = *wholeNumber(text); };
  app_->add_option_function<std::string>(name, set, meaning)
      ->check(faultOfWholeNumber)
      ->type_name(unit);
}

void Program::option(const std::string& name, std::optional<std::uint64_t>& value,
                     const std::string& unit, const std::string& meaning) {
  const auto set = [&value](const std::string& text) { value = wholeNumber(text); };
  app_->add_option_function<std::string>(name, set, meaning)
      ->check(faultOfWholeNumber)
      ->type_name(unit);
}

void Program::option(const std::string& name, std::array<double, 3>& values,
                     const std::string& units, const std::string& meaning) {
  app_->add_option(name, values, meaning)->check(faultOfNumber)->type_name(units);
}

void Program::option(const std::string& name, std::optional<std::string>& value,
                     const std::string& unit, const std::string& meaning) {
  // CLI11 by itself takes an empty word for none.
  const auto set = [&value](const std::string& text) { value = text; };
  app_->add_option_function<std::string>(name, set, meaning)->type_name(unit);
}

void Program::requiredOption(const std::string& name, std::string& value, const std::string& unit,
                             const std::string& meaning) {
  app_->add_option(name, value, meaning)->type_name(unit)->required();
}

int Program::run(int argc, const char* const* argv, const std::function<int()>& body) {
  try {
    app_->parse(argc, argv);
    return body();
  } catch (const CLI::CallForHelp&) {
    std::fputs(app_->help().c_str(), stdout);
    return 0;
  } catch (const CLI::ParseError& error) {
    return refuse(error.what());
  } catch (const UsageError& error) {
    return refuse(error.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

int Program::refuse(const std::string& reason) const {
  std::fprintf(stderr, "%s\n%s", reason.c_str(), app_->help().c_str());
  return 2;
}

}  // namespace sightline::tools
