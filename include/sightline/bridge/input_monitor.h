#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include <diagnostic_updater/diagnostic_updater.h>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/log_throttle.h"
#include "sightline/bridge/missing_input.h"
#include "sightline/scan/learned_noise.h"

namespace sightline::bridge {

/// Counts the messages of one input that were used and those that were dropped, with the last
/// reason; logs a drop once every 10 s, and shows it all in diagnostics. Goes by the steady clock,
/// whatever the time of ROS does.
class InputMonitor {
 public:
  /// Whether messages are expected to go on once they have begun, to come now and then, or perhaps
  /// never.
  enum class Flow { kSteady, kNowAndThen, kPerhaps };

  /// Registers with the updater, which has to live as long. With a `type` of message, silence is
  /// told in the log, too.
  InputMonitor(std::string topic, diagnostic_updater::Updater& updater,
               Flow flow = Flow::kNowAndThen, const std::string& type = "");

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
  void accept();
  void drop(const std::string& reason);
  /// Drops a message that nobody is to blame for: while a graph starts, some come too early.
  void skip(const std::string& reason);
  /// Shows the noise that has been learned of the scanner.
  void show(const scan::RangeNoise& noise) { noise_ = noise; }
  /// Logs something about the messages, and shows it in diagnostics: the same key once.
  void note(const std::string& key, const std::string& text);
  /// Logs something that may happen again, once every 10 s, and counts it for diagnostics.
  void warn(const std::string& text);
  /// Sentence on messages that never came, ceased, or were all of no use; empty where they come.
  std::string awaited() const;

 private:
  void count(const std::string& reason);
  MissingInput::State state() const;
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::string topic_;
  Flow flow_;
  std::size_t accepted_ = 0;
  std::size_t dropped_ = 0;
  std::size_t dropped_before_ = 0;  // at the last report
  std::string last_reason_;
  std::optional<scan::RangeNoise> noise_;
  std::map<std::string, std::string> notes_;
  std::map<std::string, std::size_t> warnings_;
  LogThrottle drops_;
  LogThrottle warned_;
  MissingInput missing_;
  // The last message, or the beginning.
  std::chrono::steady_clock::time_point last_message_ = std::chrono::steady_clock::now();
};

}  // namespace sightline::bridge
