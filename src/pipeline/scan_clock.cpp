#include "sightline/pipeline/scan_clock.h"

#include <algorithm>
#include <vector>

#include "sightline/geometry/statistics.h"

namespace sightline::pipeline {

namespace {

constexpr struct {
  // Stamps that are looked at, and the fewest that tell anything.
  std::size_t window = 64;
  std::size_t fewest = 8;
  // Stamps are those of arrival where more than this share of the steps between them is shorter
  // than this share of the period; a steady scanner has none.
  double share_short = 0.06;
  double short_step = 0.3;
  // Shorter than the period of any scanner [s]: inside a burst.
  double least_period = 0.008;
  // Period, and time that may have passed at most, while fewer stamps are known than tell the
  // period and two of them are inside a burst [s].
  double first_period = 0.1;
  double first_longest = 1.0;
  // Scans that may have been lost between two that got through, and how much longer than any other
  // step one has to be to be a pause.
  double periods_lost = 3.0;
  double pause = 2.0;
  // Standard deviation of a turn's time as a ratio, of a motor that is held to its speed.
  double period_sigma = 0.02;
} kClock;

}  // namespace

void ScanClock::add(std::int64_t stamp) {
  stamps_.push_back(stamp);
  if (stamps_.size() > kClock.window) stamps_.pop_front();
  if (stamps_.size() < kClock.fewest) {
    is_of_arrival_ = false;
  } else {
    judge();
  }
}

// Time from the stamp before to this one [s].
double ScanClock::step(std::size_t i) const {
  return 1e-9 * static_cast<double>(stamps_[i] - stamps_[i - 1]);
}

// A span over a third of the stamps holds several bursts; the median over such spans does not see a
// pause.
double ScanClock::spanMedian() const {
  const std::size_t length = stamps_.size() / 3;
  std::vector<double> spans;
  for (std::size_t i = length; i < stamps_.size(); ++i) {
    spans.push_back(1e-9 * static_cast<double>(stamps_[i] - stamps_[i - length]));
  }
  const auto middle = spans.begin() + static_cast<std::ptrdiff_t>(spans.size() / 2);
  std::nth_element(spans.begin(), middle, spans.end());
  return *middle / static_cast<double>(length);
}

void ScanClock::judge() {
  period_ = spanMedian();
  if (period_ < kClock.least_period) {
    period_ = 1e-9 * static_cast<double>(stamps_.back() - stamps_.front()) /
              static_cast<double>(stamps_.size() - 1);
  }
  std::size_t shorter = 0;
  for (std::size_t i = 1; i < stamps_.size(); ++i) {
    if (step(i) < kClock.short_step * period_) ++shorter;
  }
  const auto steps = static_cast<double>(stamps_.size() - 1);
  is_of_arrival_ = period_ > 0.0 && static_cast<double>(shorter) > kClock.share_short * steps;
}

double ScanClock::longestStepBefore() const {
  double longest = kClock.periods_lost * period_;
  for (std::size_t i = 1; i + 1 < stamps_.size(); ++i) longest = std::max(longest, step(i));
  return longest;
}

std::optional<scan::ElapsedTime> ScanClock::sinceBefore() const {
  if (stamps_.size() < 2) return std::nullopt;
  const double by_stamps = step(stamps_.size() - 1);
  if (stamps_.size() < kClock.fewest) {
    const bool is_in_burst = by_stamps > 0.0 && by_stamps < kClock.least_period;
    if (!is_in_burst) return std::nullopt;
    return scan::ElapsedTime{kClock.first_period, kClock.first_longest, kClock.first_period};
  }
  if (period_ <= 0.0) return std::nullopt;
  if (!is_of_arrival_ && by_stamps > 0.0) return std::nullopt;
  if (by_stamps > kClock.pause * longestStepBefore()) return std::nullopt;
  return scan::ElapsedTime{period_, std::max(kClock.periods_lost * period_, by_stamps),
                           kClock.period_sigma * period_};
}

}  // namespace sightline::pipeline
