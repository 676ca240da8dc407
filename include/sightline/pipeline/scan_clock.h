#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "sightline/scan/elapsed_time.h"

namespace sightline::pipeline {

/// Learns from the stamps of one scanner, in the order in which its scans arrived, whether they say
/// when a scan was made or when it got through: late, in bursts, or out of order. A scanner turns
/// steadily, so that then its period is the better measure of time.
class ScanClock {
 public:
  /// Takes the stamp of the scan that arrived last [ns].
  void add(std::int64_t stamp);
  /// Forgets the stamps: the clock that they come from was set.
  void restart() { stamps_.clear(); }

  /// Whether the stamps are those of arrival.
  bool isOfArrival() const { return is_of_arrival_; }
  /// Time between the last two scans; nothing where the stamps tell it. They do not where they are
  /// those of arrival, nor where a single one goes back.
  std::optional<scan::ElapsedTime> sinceBefore() const;

 private:
  double step(std::size_t i) const;
  double spanMedian() const;
  double longestStepBefore() const;
  void judge();

  std::deque<std::int64_t> stamps_;  // the newest ones, oldest first [ns]
  double period_ = 0.0;              // [s]
  bool is_of_arrival_ = false;
};

}  // namespace sightline::pipeline
