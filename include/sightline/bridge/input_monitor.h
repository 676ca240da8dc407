#pragma once

#include <optional>
#include <string>

#include <diagnostic_updater/diagnostic_updater.h>

#include "sightline/bridge/bad_message.h"
#include "sightline/scan/learned_noise.h"

namespace sightline::bridge {

/// Counts the messages of one input that were used and those that were dropped, with the last
/// reason; logs a drop once every 10 s, and shows it all in diagnostics.
class InputMonitor {
 public:
  /// Registers with the updater, which has to live as long.
  InputMonitor(std::string topic, diagnostic_updater::Updater& updater);

  /// Does something with a message that may throw BadMessage, and counts it either way.
  template <class Use>
  void use(const Use& use_message) {
    try {
      use_message();
      accept();
    } catch (const BadMessage& fault) {
      drop(fault.what());
    }
  }
  void accept() { ++accepted_; }
  void drop(const std::string& reason);
  /// Drops a message that nobody is to blame for: while a graph starts, some come too early.
  void skip(const std::string& reason);
  /// Shows the noise that has been learned of the scanner.
  void show(const scan::RangeNoise& noise) { noise_ = noise; }

 private:
  void count(const std::string& reason);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::string topic_;
  std::size_t accepted_ = 0;
  std::size_t dropped_ = 0;
  std::size_t dropped_before_ = 0;  // at the last report
  std::string last_reason_;
  std::optional<scan::RangeNoise> noise_;
};

}  // namespace sightline::bridge
