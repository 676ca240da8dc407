#pragma once

#include <random>

#include "sightline/driver/messages.h"

namespace sightline::test {

/// A scan of 256 samples that differ all.
inline driver::ScanReport scanReport(std::uint32_t number) {
  std::mt19937 random(number);
  driver::ScanReport report;
  report.number = number;
  report.boot = 0xB007;
  report.first_sample = 0xFFFFFF00U + number;
  report.sample_period = 400000;
  report.femtoamperes_per_count = 50;
  report.status = driver::ScanReport::kHeadMoves;
  for (int i = 0; i < 256; ++i) {
    report.head_angles.push_back(static_cast<std::int16_t>(random() % 30000 - 15000));
    const auto count = [&] {
      return static_cast<std::int32_t>(random() % (2 * driver::kMaxCount + 1)) - driver::kMaxCount;
    };
    report.currents.push_back({count(), count()});
  }
  return report;
}

}  // namespace sightline::test
