#include "sightline/logs/stamp_check.h"

#include <algorithm>
#include <cstdlib>

namespace sightline::logs {

namespace {

constexpr double kNanoseconds = 1e9;  // of a second
constexpr std::size_t kStretch = 10;  // messages, over which bursts even out
constexpr double kFar = 60.0;         // [s]
constexpr double kShortStep = 0.3;    // periods
constexpr double kLongStep = 2.5;     // periods

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double secondsBetween(std::int64_t earlier, std::int64_t later) {
  return static_cast<double>(later - earlier) / kNanoseconds;
}

double periodOf(const std::vector<std::int64_t>& stamps) {
  const std::size_t stretch = std::min(kStretch, stamps.size() - 1);
  std::vector<double> periods;
  for (std::size_t i = stretch; i < stamps.size(); ++i) {
    periods.push_back(secondsBetween(stamps[i - stretch], stamps[i]) /
                      static_cast<double>(stretch));
  }
  return std::max(0.0, median(std::move(periods)));
}

}  // namespace

void StampCheck::add(std::int64_t stamp, std::int64_t arrival) {
  stamps_.push_back(stamp);
  arrivals_.push_back(arrival);
}

std::vector<double> StampCheck::steps() const {
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps_.size(); ++i) {
    steps.push_back(secondsBetween(stamps_[i - 1], stamps_[i]));
  }
  return steps;
}

StampSummary StampCheck::summary() const {
  StampSummary summary;
  summary.messages = stamps_.size();
  std::vector<double> delays;
  for (std::size_t i = 0; i < stamps_.size(); ++i) {
    delays.push_back(secondsBetween(stamps_[i], arrivals_[i]));
    summary.without_stamp += stamps_[i] == 0;
    summary.far += stamps_[i] != 0 && std::abs(delays.back()) > kFar;
  }
  summary.delay = median(std::move(delays));
  if (stamps_.size() < 2) return summary;
  summary.period = periodOf(stamps_);
  const std::vector<double> all = steps();
  for (const double step : all) {
    summary.back += step < 0.0;
    summary.repeated += step == 0.0;
    summary.gaps += step > kLongStep * summary.period;
    summary.in_bursts += step < kShortStep * summary.period;
    summary.longest_gap = std::max(summary.longest_gap, step);
  }
  summary.in_bursts /= static_cast<double>(all.size());
  return summary;
}

}  // namespace sightline::logs
