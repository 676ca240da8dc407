#include "sightline/targets/likelihood_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
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

// Counts by range and bearing: eq. 1 says that nothing depends on the bearing within the view. Each
// cell has the mean range of what is in it.
std::vector<RangeBin> cellsOf(const std::vector<Opportunity>& opportunities) {
  constexpr double kRangeStep = 0.5;
  constexpr double kQuarters = 4.0;
  const auto by_bearing = [](const Opportunity& a, const Opportunity& b) {
    return a.place.bearing < b.place.bearing;
  };
  const auto [first, last] =
      std::minmax_element(opportunities.begin(), opportunities.end(), by_bearing);
  const double step = std::max(last->place.bearing - first->place.bearing, 1e-9) / kQuarters;
  std::map<std::pair<int, int>, RangeBin> cells;
  for (const Opportunity& one : opportunities) {
    const double quarter = (one.place.bearing - first->place.bearing) / step;
    RangeBin& cell = cells[{static_cast<int>(one.place.range / kRangeStep),
                            static_cast<int>(std::min(quarter, kQuarters - 1.0))}];
    cell.tried += 1.0;
    cell.detected += one.is_detected ? 1.0 : 0.0;
    cell.range += (one.place.range - cell.range) / cell.tried;
  }
  std::vector<RangeBin> result;
  for (const auto& [key, cell] : cells) result.push_back(cell);
  return result;
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
  const std::vector<RangeBin> wide = cellsOf(opportunities);
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

}  // namespace sightline::targets
