#include "sightline/pipeline/stamp_watch.h"

#include <cmath>

#include <fmt/format.h>

namespace sightline::pipeline {

namespace {

constexpr struct {
  // Stamps may run ahead of the arrival by this much [ns], and so many times as fast: bursts, and
  // recordings that are played fast.
  std::int64_t ahead = 2'000'000'000;
  double rate = 20.0;
} kStamps;

// Differences of times are 32-bit seconds in ROS [ns].
constexpr std::int64_t kEndOfTime = 2'147'483'647LL * 1'000'000'000;

}  // namespace

bool StampWatch::follows(const Message& last, const Message& next) {
  const auto elapsed = static_cast<double>(next.arrival - last.arrival);
  const std::int64_t advance = next.stamp - last.stamp;
  const double most = static_cast<double>(kStamps.ahead) + kStamps.rate * std::abs(elapsed);
  return advance > -kSetBack && static_cast<double>(advance) < most;
}

StampWatch::Verdict StampWatch::judge(std::int64_t stamp, std::int64_t arrival) {
  const Message message{stamp, arrival};
  if (!last_ || follows(*last_, message)) {
    // A message that comes late does not take the time back.
    if (!last_ || stamp > last_->stamp) last_ = message;
    stray_.reset();
    return Verdict::kGood;
  }
  strays_ = stray_ && follows(*stray_, message) ? strays_ + 1 : 1;
  stray_ = message;
  if (strays_ < kNewTime) return Verdict::kStray;
  last_ = message;
  stray_.reset();
  return Verdict::kClockSet;
}

void StampWatch::forget() {
  last_.reset();
  stray_.reset();
}

double StampWatch::leap(std::int64_t stamp) const {
  return last_ ? 1e-9 * static_cast<double>(stamp - last_->stamp) : 0.0;
}

std::string faultOfStamp(std::int64_t stamp) {
  if (stamp == 0) return "a stamp of zero";
  if (stamp > 0 && stamp < kEndOfTime) return "";
  return fmt::format("a stamp of {:.0f} s, out of range", 1e-9 * static_cast<double>(stamp));
}

std::string describeLeap(double seconds) {
  return seconds < 0.0 ? "a stamp far behind the ones before it"
                       : "a stamp far ahead of the ones before it";
}

}  // namespace sightline::pipeline
