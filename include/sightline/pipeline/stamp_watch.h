#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace sightline::pipeline {

/// Tells stray stamps of one source from a clock that was set. A stamp that leaps against the ones
/// before is a stray; where the next ones go on from there, the clock was set, and the old time is
/// over.
class StampWatch {
 public:
  enum class Verdict {
    kGood,
    kStray,     ///< to be left out, unless the next ones follow it
    kClockSet,  ///< the last of so many strays in a row that they are the new time
  };

  /// @param stamp    [ns]
  /// @param arrival  by a clock that goes on evenly [ns]
  Verdict judge(std::int64_t stamp, std::int64_t arrival);
  /// Takes the next stamp as it is.
  void forget();
  /// Strays in a row that follow each other.
  int strays() const { return strays_; }
  /// Leap of a stray against the last good stamp [s].
  double leap(std::int64_t stamp) const;

  /// A stamp so far back means another time, not a message that came late [ns].
  static constexpr std::int64_t kSetBack = 1'000'000'000;
  /// Stamps in a row that make a new time.
  static constexpr int kNewTime = 3;

 private:
  struct Message {
    std::int64_t stamp;
    std::int64_t arrival;
  };
  static bool follows(const Message& last, const Message& next);

  std::optional<Message> last_;   // that was good
  std::optional<Message> stray_;  // the last one, since
  int strays_ = 0;                // that follow each other
};

/// Reason for which no message with this stamp can be used, as differences of such times do not fit
/// into ROS; empty where there is none.
std::string faultOfStamp(std::int64_t stamp);
/// Reason to leave out a message whose stamp leaps by so much [s].
std::string describeLeap(double seconds);

}  // namespace sightline::pipeline
