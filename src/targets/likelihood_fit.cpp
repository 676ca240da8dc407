#include "sightline/targets/likelihood_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "sightline/geometry/statistics.h"

namespace sightline::targets {

namespace {

// Half the 95 % point of chi-square with one degree of freedom.
constexpr double kProfileDrop = 0.5 * geometry::kNormal95 * geometry::kNormal95;

double logLikelihood(double successes, double tried, double probability) {
  const double p = std::clamp(probability, 1e-9, 1.0 - 1e-9);
  return successes * std::log(p) + (tried - successes) * std::log1p(-p);
}

// The best of equally spaced values, refined; what is sought has one peak near it.
double maximise(const std::function<double(double)>& value, double low, double high) {
  constexpr double kGolden = 0.6180339887498949;
  double a = low;
  double b = high;
  for (int i = 0; i < 40; ++i) {
    const double c = b - kGolden * (b - a);
    const double d = a + kGolden * (b - a);
    (value(c) > value(d) ? b : a) = value(c) > value(d) ? d : c;
  }
  return 0.5 * (a + b);
}

// The values of a profile on a grid that lie within the drop of its best.
Fitted intervalOf(const std::vector<double>& grid, const std::vector<double>& profile,
                  double drop) {
  const auto best = std::max_element(profile.begin(), profile.end());
  const auto is_inside = [&](std::size_t i) { return profile[i] >= *best - drop; };
  Fitted result;
  result.value = grid[static_cast<std::size_t>(best - profile.begin())];
  std::size_t first = 0;
  while (!is_inside(first)) ++first;
  std::size_t last = grid.size() - 1;
  while (!is_inside(last)) --last;
  result.low = grid[first];
  result.high = grid[last];
  // Ends that lie so much lower that this happens once in a thousand times by chance.
  constexpr double kSure = 10.83 / (geometry::kNormal95 * geometry::kNormal95);
  result.is_determined =
      profile.front() < *best - kSure * drop && profile.back() < *best - kSure * drop;
  return result;
}

std::vector<double> evenly(double from, double to, int steps) {
  std::vector<double> grid;
  for (int i = 0; i <= steps; ++i) grid.push_back(from + (to - from) * i / steps);
  return grid;
}

double detectionLikelihood(const std::vector<RangeBin>& bins, double beam_spacing, double diameter,
                           double false_negative) {
  double sum = 0.0;
  for (const RangeBin& bin : bins) {
    const double covered = std::min(1.0, diameter / (bin.range * beam_spacing));
    sum += logLikelihood(bin.detected, bin.tried, (1.0 - false_negative) * covered);
  }
  return sum;
}

double saturated(const std::vector<RangeBin>& bins) {
  double sum = 0.0;
  for (const RangeBin& bin : bins) sum += logLikelihood(bin.detected, bin.tried, bin.share());
  return sum;
}

}  // namespace

DetectionLikelihood fitDetectionLikelihood(const std::vector<Opportunity>& opportunities,
                                           double beam_spacing, double inflation) {
  DetectionLikelihood result;
  const std::vector<RangeBin> bins = binByRange(opportunities, 0.05);
  if (bins.empty()) return result;
  const double drop = kProfileDrop * inflation;
  // Diameters beyond the last bin's width of a beam are all alike: the grid ends there.
  const std::vector<double> diameters = evenly(0.0, bins.back().range * beam_spacing, 300);
  std::vector<double> profile;
  for (const double diameter : diameters) {
    const auto of_misses = [&](double p) {
      return detectionLikelihood(bins, beam_spacing, diameter, p);
    };
    profile.push_back(of_misses(maximise(of_misses, 0.0, 1.0)));
  }
  result.target_diameter = intervalOf(diameters, profile, drop);
  const std::vector<double> misses = evenly(0.0, 1.0, 200);
  std::vector<double> miss_profile;
  for (const double p : misses) {
    const auto of_diameter = [&](double d) {
      return detectionLikelihood(bins, beam_spacing, d, p);
    };
    miss_profile.push_back(of_diameter(maximise(of_diameter, 0.0, diameters.back())));
  }
  result.false_negative = intervalOf(misses, miss_profile, drop);
  const std::vector<RangeBin> wide = binByRange(opportunities);
  const double at_best = detectionLikelihood(wide, beam_spacing, result.target_diameter.value,
                                             result.false_negative.value);
  result.deviance = 2.0 * (saturated(wide) - at_best) / inflation;
  constexpr double kOnceInThousand = 3.09;
  result.limit = geometry::chiSquareLimit(kOnceInThousand,
                                          std::max(1.0, static_cast<double>(wide.size()) - 2.0));
  return result;
}

namespace {

// Bearings in the peaks and beside them, for the likelihood at one width.
double peakLikelihood(double inside, double outside, const FieldOfView& view, double width,
                      double share) {
  const double even = share / view.width();
  const double peak = even + (1.0 - share) / (2.0 * width);
  return inside * std::log(std::max(peak, 1e-12)) + outside * std::log(std::max(even, 1e-12));
}

Fitted poissonMean(double count, double looks) {
  Fitted mean;
  if (looks == 0.0) return mean;
  mean.value = count / looks;
  const double half = geometry::kNormal95 * std::sqrt(std::max(count, 1.0)) / looks;
  mean.low = std::max(0.0, mean.value - half);
  mean.high = mean.value + half;
  mean.is_determined = true;
  return mean;
}

}  // namespace

ClutterLikelihood fitClutterLikelihood(const std::vector<ClutterBearing>& clutter,
                                       const FieldOfView& view, std::size_t looks) {
  ClutterLikelihood result;
  result.mean = poissonMean(static_cast<double>(clutter.size()), static_cast<double>(looks));
  result.uniform_share.value = 1.0;
  const bool holds_peaks =
      view.min <= -0.75 * geometry::kPi + 1e-9 && view.max >= 0.75 * geometry::kPi - 1e-9;
  if (!holds_peaks || clutter.empty()) return result;
  const std::vector<double> widths = evenly(0.005, 0.5 * geometry::kPi, 400);
  std::vector<double> width_profile;
  const std::vector<double> shares = evenly(0.0, 1.0, 200);
  std::vector<double> share_profile(shares.size(), -std::numeric_limits<double>::infinity());
  for (const double width : widths) {
    const auto inside = static_cast<double>(
        std::count_if(clutter.begin(), clutter.end(), [&](const ClutterBearing& one) {
          return std::abs(std::abs(one.bearing) - 0.5 * geometry::kPi) <= 0.5 * width;
        }));
    const double outside = static_cast<double>(clutter.size()) - inside;
    width_profile.push_back(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const double value = peakLikelihood(inside, outside, view, width, shares[i]);
      width_profile.back() = std::max(width_profile.back(), value);
      share_profile[i] = std::max(share_profile[i], value);
    }
  }
  result.peak_width = intervalOf(widths, width_profile, kProfileDrop);
  result.uniform_share = intervalOf(shares, share_profile, kProfileDrop);
  return result;
}

namespace {

// A Gaussian, a wider one of the same mean, and an even background, by expectation maximisation.
struct ErrorMixture {
  static constexpr double kWide = 2.5;  // standard deviation of the wider one, in those of the core

  double sigma;
  double bias = 0.0;
  double core = 0.6;  // shares
  double wide = 0.2;

  static double gaussianAt(double scaled, double sigma) {
    return std::exp(-0.5 * scaled * scaled) / (sigma * std::sqrt(2.0 * geometry::kPi));
  }

  // Probabilities that an error is of the core, and of the wider one.
  std::pair<double, double> belongs(double error, double gate) const {
    const double scaled = (error - bias) / sigma;
    const double of_core = core * gaussianAt(scaled, sigma);
    const double of_wide = wide * gaussianAt(scaled / kWide, kWide * sigma);
    const double sum = of_core + of_wide + (1.0 - core - wide) / (2.0 * gate);
    return {of_core / sum, of_wide / sum};
  }

  void step(const std::vector<double>& errors, double gate) {
    double cores = 0.0;
    double wides = 0.0;
    double weights = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (const double error : errors) {
      const auto [of_core, of_wide] = belongs(error, gate);
      // The wider one's errors, scaled to the core's.
      const double weight = of_core + of_wide / (kWide * kWide);
      cores += of_core;
      wides += of_wide;
      weights += weight;
      sum += weight * error;
      squares += weight * error * error;
    }
    bias = sum / weights;
    sigma = std::sqrt(std::max((squares - weights * bias * bias) / (cores + wides), 1e-10));
    const auto count = static_cast<double>(errors.size());
    core = std::min(cores / count, 1.0 - 1e-6);
    wide = std::min(wides / count, 1.0 - 1e-6 - core);
  }

  // Standard deviation of both Gaussians together over that of the core.
  double tail() const { return std::sqrt((core + kWide * kWide * wide) / (core + wide)); }
};

ErrorMixture mixtureOf(const std::vector<double>& errors, double gate) {
  ErrorMixture mixture{gate / 3.0};
  for (int i = 0; i < 200; ++i) mixture.step(errors, gate);
  return mixture;
}

// What is left of errors when those of a lag are taken away.
std::vector<double> withoutLag(const std::vector<KnownLook>& looks,
                               const std::vector<Opportunity>& labelled, double lag) {
  std::vector<double> errors;
  for (const Opportunity& one : labelled) {
    if (one.is_detected) errors.push_back(one.error - lag * looks[one.look].turn_rate);
  }
  return errors;
}

// Sums of the regression of errors on the turn rate.
struct LagSums {
  double rates = 0.0;
  double products = 0.0;

  void add(double weight, double rate, double error) {
    rates += weight * rate * rate;
    products += weight * rate * error;
  }
};

// Weighs each error by how much of it belongs to the Gaussians once the lag found so far is gone.
LagSums lagSums(const std::vector<KnownLook>& looks, const std::vector<Opportunity>& labelled,
                const ErrorMixture& mixture, double lag, double gate) {
  LagSums sums;
  for (const Opportunity& one : labelled) {
    if (!one.is_detected) continue;
    const double rate = looks[one.look].turn_rate;
    const auto [core, wide] = mixture.belongs(one.error - lag * rate, gate);
    const double kept = core + wide / (ErrorMixture::kWide * ErrorMixture::kWide);
    sums.add(kept, rate, one.error - mixture.bias);
  }
  return sums;
}

}  // namespace

ErrorFit fitErrors(const std::vector<KnownLook>& looks, const std::vector<Opportunity>& labelled,
                   double gate) {
  constexpr std::size_t kFewest = 30;
  constexpr int kRounds = 15;
  ErrorFit result;
  result.used = withoutLag(looks, labelled, 0.0).size();
  if (result.used < kFewest) return result;
  ErrorMixture mixture{gate / 3.0};
  for (int round = 0; round < kRounds; ++round) {
    mixture = mixtureOf(withoutLag(looks, labelled, result.lag), gate);
    const LagSums sums = lagSums(looks, labelled, mixture, result.lag, gate);
    if (sums.rates <= 0.0) break;
    result.lag = sums.products / sums.rates;
    result.lag_sigma = mixture.sigma / std::sqrt(sums.rates);
  }
  result.sigma = mixture.sigma;
  result.bias = mixture.bias;
  result.tail = mixture.tail();
  return result;
}

}  // namespace sightline::targets
