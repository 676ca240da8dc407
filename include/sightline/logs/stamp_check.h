#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline::logs {

/// What the stamps of a topic are like. Times in [s].
struct StampSummary {
  std::size_t messages = 0;
  std::size_t without_stamp = 0;  ///< stamp of zero
  std::size_t far = 0;            ///< more than a minute from their arrival
  std::size_t back = 0;           ///< older than the one before
  std::size_t repeated = 0;       ///< same as the one before
  std::size_t gaps = 0;           ///< steps longer than 2.5 periods
  double period = 0.0;            ///< as it is in most stretches of ten messages; 0: not known
  double longest_gap = 0.0;
  double in_bursts = 0.0;  ///< share of the steps shorter than .3 periods: stamps of arrival
  double delay = 0.0;      ///< of the arrival behind the stamp, median
};

/// Gathers the stamps of a topic.
class StampCheck {
 public:
  /// Stamp and arrival of a message [ns].
  void add(std::int64_t stamp, std::int64_t arrival);
  StampSummary summary() const;
  /// Steps between stamps in the order of arrival [s].
  std::vector<double> steps() const;
  const std::vector<std::int64_t>& stamps() const { return stamps_; }

 private:
  std::vector<std::int64_t> stamps_;
  std::vector<std::int64_t> arrivals_;
};

}  // namespace sightline::logs
