#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "sightline/config/fields.h"

namespace sightline::driver {

struct ClockConfig {
  double window = 120.0;     ///< [s]
  double max_drift = 500.0;  ///< [ppm]
  double latency = -1.0;     ///< [s]; negative: measured

  void visit(config::FieldVisitor& visitor);
};

/// Time of a host from the clock of a device: 32 bits of microseconds that wrap, drift, and start
/// anew with the device, known only through messages that arrive late.
///
/// A delay is constant plus something that is never negative and now and then nearly nothing. So
/// the line below all differences of arrival and departure that lies closest to them (in the sum,
/// an edge of their lower convex hull) has the drift for its slope and is off by the constant part
/// alone. The constant part is a parameter or, with messages in the other direction as well, half
/// of what lies between the two lines, both ways taken for equally slow.
///
/// Host times are those of a clock that never jumps [ns]; a message's are those of its last byte,
/// without the time that its bytes take on the line.
class ClockEstimator {
 public:
  explicit ClockEstimator(const ClockConfig& config = {}) : config_(config) {}

  /// A message left the device at `device` and was here at `host`. One that is early by more than a
  /// second is of a new clock; one that is so late has waited somewhere and tells nothing, unless
  /// all have been for two seconds.
  void observeArrival(std::uint32_t device, std::int64_t host);
  /// A message left here at `host` and was with the device at `device`. Ignored before the first
  /// arrival.
  void observeDeparture(std::int64_t host, std::uint32_t device);
  /// The device starts anew.
  void reset();

  /// Time by which a message that left the device at `device` and came at `host` is later than
  /// messages of the last seconds in the other direction allow [s]; negative: it came before it was
  /// sent, by one clock or the other. Nothing where there were none.
  std::optional<double> slackOfArrival(std::uint32_t device, std::int64_t host) const;
  /// The same of a message that left here at `host` and was with the device at `device`.
  std::optional<double> slackOfDeparture(std::int64_t host, std::uint32_t device) const;

  /// Host time [ns] of a device time within half an hour of the last arrival; nothing before the
  /// first one.
  std::optional<std::int64_t> hostTime(std::uint32_t device) const;

  double drift() const { return slope_; }  ///< host seconds a device second, less one
  /// [s]; the parameter, or what was measured; 0 before there is any departure.
  double latency() const;
  std::size_t observations() const { return arrivals_.size(); }
  std::size_t resets() const { return resets_; }  ///< clocks that started anew by themselves

 private:
  /// Device time since the first arrival and what host time is ahead of it, both in seconds.
  struct Point {
    double device;
    double ahead;
  };

  double aheadOf(double device_seconds, std::int64_t host) const;
  bool isOtherClock(double late, std::int64_t host);
  double deviceSeconds(std::uint32_t device) const;
  double aheadAt(double device) const { return ahead_ + slope_ * device; }
  void forgetBefore(double device);
  void fitBelowArrivals();

  ClockConfig config_;
  std::deque<Point> arrivals_;
  std::deque<Point> departures_;  // ahead: of a message that took no time at least so much
  std::uint32_t last_device_ = 0;
  double last_seconds_ = 0.0;  // of last_device_
  std::int64_t origin_ = 0;    // host time of the first arrival [ns]
  double slope_ = 0.0;
  double ahead_ = 0.0;      // of the line at device time 0
  double held_back_ = 0.0;  // between the line of the arrivals and the least late departure [s]
  std::optional<std::int64_t> late_since_;  // host time [ns]
  std::size_t resets_ = 0;
};

}  // namespace sightline::driver
