#include "sightline/pipeline/scan_schedule.h"

namespace sightline::pipeline {

namespace {

// A scan may be late by this share of the period, and is not awaited with periods longer than this.
constexpr std::int64_t kLate = 4;                     // 1 / share
constexpr std::int64_t kLongestPeriod = 500'000'000;  // ns

}  // namespace

void ScanSchedule::add(std::int64_t stamp, std::int64_t arrival) {
  const std::int64_t step = stamp_ ? stamp - *stamp_ : 0;
  period_ = step > 0 && step <= kLongestPeriod ? step : 0;
  stamp_ = stamp;
  arrival_ = arrival;
}

bool ScanSchedule::awaits(std::int64_t stamp, std::int64_t now) const {
  if (period_ == 0 || *stamp_ + period_ >= stamp) return false;
  return now < arrival_ + period_ + period_ / kLate;
}

}  // namespace sightline::pipeline
