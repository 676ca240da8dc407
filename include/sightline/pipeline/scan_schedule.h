#pragma once

#include <cstdint>
#include <optional>

namespace sightline::pipeline {

/// Foresees when the next scan of a scanner comes, by the last two: so that another scanner's scan
/// can wait for one that was taken before it and comes after it.
class ScanSchedule {
 public:
  /// Takes stamp and arrival of the scan that came last, by two clocks that go alike [ns].
  void add(std::int64_t stamp, std::int64_t arrival);
  /// Whether the next scan should bear a stamp before this one, and has not been due for long.
  bool awaits(std::int64_t stamp, std::int64_t now) const;

 private:
  std::optional<std::int64_t> stamp_;
  std::int64_t arrival_ = 0;
  std::int64_t period_ = 0;  // 0: not known
};

}  // namespace sightline::pipeline
