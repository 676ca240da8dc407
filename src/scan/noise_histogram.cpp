#include "sightline/scan/noise_histogram.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace sightline::scan {

namespace {

// The upper bits of a float are its logarithm, but for a straight line within each octave.
constexpr std::uint32_t kMantissaBits = 23;
constexpr std::uint32_t kBias = 127;

constexpr std::size_t lowest(int octave, std::uint32_t bits) {
  return static_cast<std::size_t>(static_cast<int>(kBias) + octave) << bits;
}

// Bins an octave: 2^Bits; the first begins at 2^Octave.
template <std::uint32_t Bits, int Octave, std::size_t Bins>
std::size_t binOf(double value) {
  const auto narrow = static_cast<float>(value);
  std::uint32_t word = 0;
  std::memcpy(&word, &narrow, sizeof(word));
  constexpr std::size_t kFirst = lowest(Octave, Bits);
  const std::size_t place = word >> (kMantissaBits - Bits);
  return std::clamp(place, kFirst, kFirst + Bins - 1) - kFirst;
}

// Lower border of a bin.
template <std::uint32_t Bits, int Octave>
double borderOf(std::size_t bin) {
  constexpr std::size_t kBins = std::size_t{1} << Bits;
  const double share = static_cast<double>(bin % kBins) / static_cast<double>(kBins);
  return std::ldexp(1.0 + share, Octave + static_cast<int>(bin / kBins));
}

constexpr std::uint32_t kRangeBits = 1;
constexpr int kRangeOctave = -4;
constexpr std::uint32_t kDistanceBits = 2;
constexpr int kDistanceOctave = -13;

// A share of a step, different from beam to beam and the same in every scan (a linear congruential
// generator).
class Dither {
 public:
  explicit Dither(double step) : step_(step) {}
  double next() {
    state_ = state_ * 1664525U + 1013904223U;
    return step_ * (std::ldexp(static_cast<double>(state_), -32) - 0.5);
  }

 private:
  double step_;
  std::uint32_t state_ = 1;
};

}  // namespace

double NoiseHistogram::squaredRange(std::size_t range) {
  const double lower = borderOf<kRangeBits, kRangeOctave>(range);
  const double upper = borderOf<kRangeBits, kRangeOctave>(range + 1);
  return (lower * lower + lower * upper + upper * upper) / 3.0;
}

// The first bin holds all from zero on.
double NoiseHistogram::distance(std::size_t bin) {
  return borderOf<kDistanceBits, kDistanceOctave>(bin + 1) - 0.5 * width(bin);
}

double NoiseHistogram::width(std::size_t bin) {
  const double lower = bin == 0 ? 0.0 : borderOf<kDistanceBits, kDistanceOctave>(bin);
  return borderOf<kDistanceBits, kDistanceOctave>(bin + 1) - lower;
}

void NoiseHistogram::add(const Scan& scan, double step) {
  const auto& cosines = scan.geometry()->cosines();
  const auto& sines = scan.geometry()->sines();
  const auto sine = [&](std::size_t i, std::size_t k) {
    return cosines[i] * sines[k] - sines[i] * cosines[k];
  };
  Dither dither(step);
  double before = 0.0;
  double middle = 0.0;
  std::size_t valid = 0;  // in a row, up to here
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const double after = scan.ranges()[i] + dither.next();
    valid = scan.isValid(i) ? valid + 1 : 0;
    if (valid >= 3) {
      const double whole = sine(i - 2, i);
      const double a = sine(i - 1, i) / (whole * before);
      const double b = sine(i - 2, i - 1) / (whole * after);
      const double predicted = 1.0 / (a + b);
      const double by_before = predicted * predicted * a / before;
      const double by_after = predicted * predicted * b / after;
      const double scale = std::sqrt(1.0 + by_before * by_before + by_after * by_after);
      count(middle, std::abs(middle - predicted) / scale);
    }
    before = middle;
    middle = after;
  }
}

void NoiseHistogram::count(double range, double distance) {
  if (!std::isfinite(distance)) return;
  const std::size_t row = binOf<kRangeBits, kRangeOctave, kRanges>(range);
  counts_[row][binOf<kDistanceBits, kDistanceOctave, kDistances>(distance)] += 1.0;
  total_ += 1.0;
}

void NoiseHistogram::scale(double factor) {
  for (auto& row : counts_) {
    for (double& cell : row) cell *= factor;
  }
  total_ *= factor;
}

}  // namespace sightline::scan
