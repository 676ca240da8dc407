#pragma once

#include <array>
#include <cstddef>

#include "sightline/scan/scan.h"

namespace sightline::scan {

/// Distances of returns from the straight line through the returns on either side, by range.
///
/// On a line 1/r = n·d/ρ is linear in the direction d, so that the neighbours predict the return
/// between them. The distance is divided by what the noise of three equal ranges makes of it: on
/// anything straight it has the standard deviation of the noise along a beam; where a step or an
/// edge is among the three, it may be anything.
class NoiseHistogram {
 public:
  /// Ranges from 2^-4 m, distances from 2^-13 m on; what is beyond counts in the outermost bin.
  static constexpr std::size_t kRanges = 22;     ///< two bins an octave
  static constexpr std::size_t kDistances = 64;  ///< four bins an octave

  /// Counts the returns of a scan. Ranges counted in steps are spread over the step first, so that
  /// distances do not gather on its multiples: the variance grows by step²/12.
  void add(const Scan& scan, double step);
  /// Lets old counts weigh less.
  void scale(double factor);

  double total() const { return total_; }
  double count(std::size_t range, std::size_t distance) const { return counts_[range][distance]; }
  /// Square of the range in the middle of a bin [m²].
  static double squaredRange(std::size_t range);
  /// Distance in the middle of a bin, and the width of the bin [m].
  static double distance(std::size_t bin);
  static double width(std::size_t bin);

 private:
  void count(double range, double distance);

  std::array<std::array<double, kDistances>, kRanges> counts_{};
  double total_ = 0.0;
};

}  // namespace sightline::scan
