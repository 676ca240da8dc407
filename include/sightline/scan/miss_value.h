#pragma once

#include <vector>

#include "sightline/scan/scan.h"

namespace sightline::scan {

/// Finds the values by which a scanner says that nothing came back, where it neither says +Inf nor
/// more than its range_max: range_max itself, or a value of its own just below it. No surface
/// answers so many beams with the very same range near the end of what is seen.
///
/// Such a value is known from the first scan that shows it beyond doubt: equal ranges in a row over
/// more of an angle than a straight wall can be equally far (to the step in which the scanner
/// counts), or far more often than any other range. From then on each beam that ends there saw
/// nothing, until beams end far beyond.
class MissValue {
 public:
  /// Turns the misses of a scan into kNothing.
  void mark(Scan& scan);
  /// Known values [m].
  const std::vector<double>& values() const { return values_; }

 private:
  void forgetBelow(double range);

  std::vector<double> values_;
};

}  // namespace sightline::scan
