#pragma once

#include <cstddef>

#include "sightline/scan/scan.h"

namespace sightline::scan {

/// Finds the step in which a scanner counts its ranges: the greatest common divisor of the
/// differences between neighbouring beams.
class RangeStep {
 public:
  void look(const Scan& scan);
  /// [m]; 0 where the ranges are as good as continuous, or too few differences have been seen.
  double step() const { return is_continuous_ || differences_ < kEnough ? 0.0 : divisor_; }

 private:
  static constexpr std::size_t kEnough = 50;
  void take(double difference);

  double divisor_ = 0.0;
  std::size_t differences_ = 0;
  bool is_continuous_ = false;
};

}  // namespace sightline::scan
