#include "sightline/scan/range_step.h"

#include <cmath>

namespace sightline::scan {

namespace {

struct RangeStepConstants {
  // Steps below this are no matter: their noise is less than any scanner's [m].
  double finest = 0.0015;
  // Differences that are looked at [m]: those of equal ranges are rounding of the message, and over
  // long ones the error of the step adds up.
  double least_difference = 1e-5;
  double largest_difference = 0.5;
  // A remainder below this share of the step is none.
  double tolerance = 0.05;
};
constexpr RangeStepConstants kStep{};

// Euclid's algorithm, with the nearest multiple.
double commonDivisor(double a, double b) {
  while (b > kStep.finest) {
    const double remainder = std::abs(std::remainder(a, b));
    if (remainder <= kStep.tolerance * b) return b;
    a = b;
    b = remainder;
  }
  return b;
}

}  // namespace

void RangeStep::look(const Scan& scan) {
  for (std::size_t i = 1; i < scan.beams() && !is_continuous_; ++i) {
    if (scan.isValid(i - 1) && scan.isValid(i)) {
      take(std::abs(scan.ranges()[i] - scan.ranges()[i - 1]));
    }
  }
}

void RangeStep::take(double difference) {
  if (difference < kStep.least_difference || difference > kStep.largest_difference) return;
  ++differences_;
  divisor_ = differences_ == 1 ? difference : commonDivisor(difference, divisor_);
  is_continuous_ = divisor_ < kStep.finest;
}

}  // namespace sightline::scan
