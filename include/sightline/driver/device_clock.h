#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "sightline/driver/clock_estimator.h"
#include "sightline/driver/messages.h"

namespace sightline::driver {

/// Host time of the samples of a device, also where its clocks contradict themselves.
///
/// Nothing is received before it was sent, and no scan begins before the one ahead of it has ended.
/// A clock that says so has been set, and is learned anew. A header whose clock does not lie
/// between the last sample and two seconds later is not believed; the last sample stands in for it.
/// A stamp after the arrival is impossible: the arrival gives it then.
///
/// Bytes of a serial line take ten bits each at its baud rate. Native USB takes the same bytes at
/// once: scans, from whose arrival the time of their bytes is subtracted, then come before they
/// were sent, by up to that time, while the short answers to pings do not.
class DeviceClock {
 public:
  struct Counts {
    std::size_t resets = 0;         ///< of a clock that was set or started anew by itself
    std::size_t wrong_headers = 0;  ///< frames with an impossible clock in the header
    std::size_t bridged = 0;        ///< scans stamped by their arrival
  };

  DeviceClock(const ClockConfig& config, int baud_rate)
      : estimator_(config), baud_rate_(baud_rate) {}

  /// A line was opened; how fast it is, is open.
  void open();
  /// The device has started anew.
  void restart();

  /// Host time of the first sample [ns]. `host` is when the last byte of the frame came.
  std::int64_t stampOf(const Frame& frame, const ScanReport& report, std::int64_t host);
  /// The ping's last byte left here at `sent`, its answer's came at `host` [ns].
  void takePong(const Frame& frame, const Pong& pong, std::int64_t sent, std::int64_t host);

  /// Time that so many bytes take on this line [ns].
  std::int64_t lineTime(std::size_t bytes) const;
  /// Whether bytes come faster than the baud rate allows.
  bool isFasterThanSerial() const { return speed_ == Speed::kUsb; }

  double drift() const { return estimator_.drift(); }
  double latency() const { return estimator_.latency(); }
  Counts counts() const;

 private:
  enum class Speed { kOpen, kSerial, kUsb };

  void checkOrder(const ScanReport& report);
  std::uint32_t departureOf(std::uint32_t header_clock, std::uint32_t not_before);
  void observe(std::uint32_t departure, std::size_t bytes, std::int64_t host);
  void vote(bool for_usb);
  void setAnew();

  ClockEstimator estimator_;
  int baud_rate_;
  Counts counts_;
  Speed speed_ = Speed::kOpen;
  int votes_ = 0;                             // in a row; negative: for a serial line
  std::optional<std::uint32_t> next_number_;  // of the scan
  std::uint32_t last_end_ = 0;                // device clock at the last sample [µs]
};

}  // namespace sightline::driver
