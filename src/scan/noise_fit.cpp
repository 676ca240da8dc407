#include "sightline/scan/noise_fit.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/angle.h"

namespace sightline::scan {

namespace {

struct NoiseFitConstants {
  // Standard deviations to start from: octaves and their halves [m].
  double least_start = 0.0005;
  double largest_start = 0.3;
  double start_ratio = 1.4142135623730951;
  int start_steps = 2;
  // Relative change of a variance that no longer matters.
  double settled = 0.005;
  // Share of noise before anything is known, and the distances that this weighs as much as.
  double usual_share = 0.5;
  double usual_weight = 4.0;
  double least_variance = 1e-10;  // [m²]
  // Structure below this many standard deviations is lost in the noise; its largest size [m].
  double knee = 3.0;
  double largest = 8.0;
};
constexpr NoiseFitConstants kFit{};

using Distances = std::array<double, NoiseHistogram::kDistances>;

struct Bins {
  Distances squared;  // of the middle
  Distances width;
  Distances moment;  // width times middle
};

const Bins& bins() {
  static const Bins kBins = [] {
    Bins result{};
    for (std::size_t i = 0; i < result.width.size(); ++i) {
      const double distance = NoiseHistogram::distance(i);
      const double width = NoiseHistogram::width(i);
      result.squared[i] = distance * distance + width * width / 12.0;
      result.width[i] = width;
      result.moment[i] = width * distance;
    }
    return result;
  }();
  return kBins;
}

// Probabilities of the bins where the noise has a variance.
class Mixture {
 public:
  explicit Mixture(double variance)
      : scale_(std::sqrt(2.0 / (geometry::kPi * variance))),
        falling_(-0.5 / variance),
        knee_(kFit.knee * kFit.knee * variance),
        octaves_(2.0 / std::log1p(kFit.largest * kFit.largest / knee_)) {}

  double noise(std::size_t bin) const {
    return scale_ * bins().width[bin] * std::exp(falling_ * bins().squared[bin]);
  }
  // Structure: each octave as likely as the next, down to where the noise hides it.
  double structure(std::size_t bin) const {
    return octaves_ * bins().moment[bin] / (bins().squared[bin] + knee_);
  }

 private:
  double scale_;
  double falling_;
  double knee_;
  double octaves_;
};

Distances atAllRanges(const NoiseHistogram& histogram) {
  Distances counts{};
  for (std::size_t k = 0; k < NoiseHistogram::kRanges; ++k) {
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += histogram.count(k, i);
  }
  return counts;
}

// Log-likelihood with the share of noise that makes it largest, about.
double likelihood(const Distances& counts, double total, double variance) {
  const Mixture mixture(variance);
  double share = kFit.usual_share;
  double result = 0.0;
  for (int step = 0; step <= kFit.start_steps; ++step) {
    double noise = 0.0;
    result = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == 0.0) continue;
      const double as_noise = share * mixture.noise(i);
      const double either = as_noise + (1.0 - share) * mixture.structure(i);
      noise += counts[i] * as_noise / either;
      result += counts[i] * std::log(either);
    }
    share = noise / total;
  }
  return result;
}

}  // namespace

// Distances at one range, each counted as far as it is noise.
struct NoiseFit::Row {
  double squared_range = 0.0;
  double weight = 0.0;
  double squares = 0.0;
};

void NoiseFit::start(const NoiseHistogram& histogram) {
  const Distances counts = atAllRanges(histogram);
  double best = 0.0;
  constant_ = 0.0;
  for (double sigma = kFit.least_start; sigma < kFit.largest_start; sigma *= kFit.start_ratio) {
    const double found = likelihood(counts, histogram.total(), sigma * sigma);
    if (constant_ != 0.0 && found <= best) continue;
    best = found;
    constant_ = sigma * sigma;
  }
  growth_ = 0.0;
  shares_.fill(kFit.usual_share);
}

void NoiseFit::improve(const NoiseHistogram& histogram, int steps) {
  bool changes = true;
  for (int i = 0; changes && i < steps; ++i) {
    const double constant = constant_;
    const double growth = growth_;
    step(histogram);
    changes = std::abs(constant_ - constant) > kFit.settled * constant ||
              std::abs(growth_ - growth) > kFit.settled * growth;
  }
}

void NoiseFit::step(const NoiseHistogram& histogram) {
  std::array<Row, NoiseHistogram::kRanges> rows{};
  normal_ = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Row& row = rows[k];
    row.squared_range = NoiseHistogram::squaredRange(k);
    const Mixture mixture(constant_ + growth_ * row.squared_range);
    double total = 0.0;
    for (std::size_t i = 0; i < NoiseHistogram::kDistances; ++i) {
      const double count = histogram.count(k, i);
      if (count == 0.0) continue;
      const double as_noise = shares_[k] * mixture.noise(i);
      const double as_structure = (1.0 - shares_[k]) * mixture.structure(i);
      const double weight = count * as_noise / (as_noise + as_structure);
      row.weight += weight;
      row.squares += weight * bins().squared[i];
      total += count;
    }
    shares_[k] = (row.weight + kFit.usual_share * kFit.usual_weight) / (total + kFit.usual_weight);
    normal_ += row.weight;
  }
  solve(rows);
}

// A step of Fisher scoring for Σ weight (log v + (squares/weight)/v), v = constant + growth r²,
// with neither part negative.
void NoiseFit::solve(const std::array<Row, NoiseHistogram::kRanges>& rows) {
  double one = 0.0, r = 0.0, rr = 0.0, y = 0.0, ry = 0.0;
  for (const Row& row : rows) {
    const double variance = constant_ + growth_ * row.squared_range;
    const double scale = 1.0 / (variance * variance);
    one += scale * row.weight;
    r += scale * row.weight * row.squared_range;
    rr += scale * row.weight * row.squared_range * row.squared_range;
    y += scale * row.squares;
    ry += scale * row.squares * row.squared_range;
  }
  if (!(one > 0.0)) return;
  const double determinant = one * rr - r * r;
  const bool is_determined = determinant > 1e-9 * one * rr;
  growth_ = is_determined ? std::max(0.0, (one * ry - r * y) / determinant) : 0.0;
  constant_ = (y - growth_ * r) / one;
  if (constant_ < kFit.least_variance) {
    constant_ = kFit.least_variance;
    growth_ = std::max(0.0, (ry - constant_ * r) / rr);
  }
}

}  // namespace sightline::scan
