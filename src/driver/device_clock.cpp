#include "sightline/driver/device_clock.h"

#include <algorithm>
#include <cmath>

#include "sightline/driver/frame.h"

namespace sightline::driver {

namespace {

constexpr double kTolerance = 3e-3;            // [s]: of a contradiction in time
constexpr std::int32_t kEarly = 1'000;         // [µs], rounding of a device's own clock
constexpr std::int32_t kHeldBack = 2'000'000;  // [µs] that a device keeps a frame at most
constexpr std::int64_t kFuture = 2'000'000;    // [ns] that a stamp may err into the future
constexpr int kVotes = 5;                      // that decide how fast a line is

std::size_t sizeOf(const Frame& frame) {
  return kHeaderSize + frame.payload.size + kTrailerSize;
}

// From the first sample to the last [ns].
std::int64_t durationOf(const ScanReport& report) {
  return static_cast<std::int64_t>(report.currents.size() - 1) * report.sample_period;
}

std::uint32_t lastSampleOf(const ScanReport& report) {
  return report.first_sample + static_cast<std::uint32_t>(durationOf(report) / 1000);
}

std::int32_t between(std::uint32_t from, std::uint32_t to) {
  return static_cast<std::int32_t>(to - from);
}

}  // namespace

void DeviceClock::open() {
  speed_ = Speed::kOpen;
  votes_ = 0;
}

void DeviceClock::restart() {
  estimator_.reset();
  next_number_.reset();
}

void DeviceClock::setAnew() {
  ++counts_.resets;
  estimator_.reset();
}

DeviceClock::Counts DeviceClock::counts() const {
  Counts counts = counts_;
  counts.resets += estimator_.resets();
  return counts;
}

std::int64_t DeviceClock::lineTime(std::size_t bytes) const {
  if (speed_ == Speed::kUsb) return 0;
  return static_cast<std::int64_t>(1e9 * lineSeconds(bytes, baud_rate_));
}

// A clock that was set back within a scan shows in the next one.
void DeviceClock::checkOrder(const ScanReport& report) {
  const bool follows = next_number_ && report.number == *next_number_;
  if (follows && between(last_end_, report.first_sample) < -kEarly) setAnew();
  next_number_ = report.number + 1;
  last_end_ = lastSampleOf(report);
}

std::uint32_t DeviceClock::departureOf(std::uint32_t header_clock, std::uint32_t not_before) {
  const std::int32_t held_back = between(not_before, header_clock);
  if (held_back >= -kEarly && held_back <= kHeldBack) return header_clock;
  ++counts_.wrong_headers;
  return not_before;
}

void DeviceClock::vote(bool for_usb) {
  votes_ = for_usb ? std::max(votes_, 0) + 1 : std::min(votes_, 0) - 1;
  if (std::abs(votes_) < kVotes) return;
  speed_ = for_usb ? Speed::kUsb : Speed::kSerial;
  if (for_usb) estimator_.reset();  // it learned from arrivals that were taken for too early
}

void DeviceClock::observe(std::uint32_t departure, std::size_t bytes, std::int64_t host) {
  const std::int64_t on_line = lineTime(bytes);
  const auto slack = estimator_.slackOfArrival(departure, host - on_line);
  const double at_once = 1e-9 * static_cast<double>(on_line);
  const bool tells_speed = slack && speed_ == Speed::kOpen && at_once > 2.0 * kTolerance;
  if (slack && *slack < -kTolerance) {
    const bool is_early = tells_speed && *slack + at_once >= -kTolerance;
    if (!is_early) setAnew();
  }
  if (tells_speed) vote(*slack < -kTolerance);
  estimator_.observeArrival(departure, host - lineTime(bytes));
}

std::int64_t DeviceClock::stampOf(const Frame& frame, const ScanReport& report, std::int64_t host) {
  checkOrder(report);
  observe(departureOf(frame.header.clock, lastSampleOf(report)), sizeOf(frame), host);
  const std::int64_t latest = host - lineTime(sizeOf(frame)) - durationOf(report);
  const auto time = estimator_.hostTime(report.first_sample);
  if (time && *time <= latest + kFuture) return std::min(*time, latest);
  ++counts_.bridged;
  if (time) setAnew();
  return latest;
}

void DeviceClock::takePong(const Frame& frame, const Pong& pong, std::int64_t sent,
                           std::int64_t host) {
  observe(departureOf(frame.header.clock, pong.received), sizeOf(frame), host);
  const auto slack = estimator_.slackOfDeparture(sent, pong.received);
  if (slack && *slack < -kTolerance && speed_ != Speed::kOpen) setAnew();
  estimator_.observeDeparture(sent, pong.received);
}

}  // namespace sightline::driver
