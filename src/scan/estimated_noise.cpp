#include "sightline/scan/estimated_noise.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "sightline/geometry/statistics.h"

namespace sightline::scan {

namespace {

// Returns that are fitted with a line to learn of their noise.
constexpr std::size_t kRun = 8;
constexpr auto kReturns = static_cast<double>(kRun);
// Runs that tell enough, and groups of like range into which they are sorted at most.
constexpr std::size_t kFewestRuns = 3;
constexpr std::size_t kRunsOfGroup = 8;
constexpr std::size_t kMostGroups = 8;
// A line through a run takes two degrees of freedom.
constexpr double kMedian = geometry::chiSquareMedianRatio(kReturns - 2.0);

// Along the beams, of a run about the line that fits it best: 1/r = n·d/ρ is linear in the
// direction d, with the noise of r over r².
NoiseAtRange noiseOfRun(const Scan& scan, std::size_t first) {
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  Eigen::Vector2d products(0, 0);
  double sum = 0.0;
  for (std::size_t i = first; i < first + kRun; ++i) {
    const double range = scan.ranges()[i];
    const Eigen::Vector2d row =
        range * range * Eigen::Vector2d(scan.geometry()->cosines()[i], scan.geometry()->sines()[i]);
    squares += row * row.transpose();
    products += row * range;
    sum += range * range;
  }
  const double left = sum - products.dot(squares.ldlt().solve(products));
  return {scan.ranges()[first + kRun / 2], std::max(0.0, left) / (kReturns - 2.0)};
}

std::vector<NoiseAtRange> noiseOfRuns(const Scan& scan) {
  std::vector<NoiseAtRange> runs;
  std::size_t valid = 0;  // in a row, up to here
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    valid = scan.isValid(i) ? valid + 1 : 0;
    if (valid < kRun) continue;
    valid = 0;
    runs.push_back(noiseOfRun(scan, i + 1 - kRun));
  }
  return runs;
}

bool isNearer(const NoiseAtRange& a, const NoiseAtRange& b) {
  return a.range < b.range;
}

template <class Iterator>
NoiseAtRange medianOf(Iterator first, Iterator end) {
  const Iterator middle = first + (end - first) / 2;
  NoiseAtRange noise{middle->range, 0.0};
  std::nth_element(first, middle, end,
                   [](const auto& a, const auto& b) { return a.variance < b.variance; });
  noise.variance = middle->variance / kMedian;
  return noise;
}

// Groups that fall with the range are given their mean (pooled adjacent violators).
void makeMonotonic(std::vector<NoiseAtRange>& noise) {
  for (std::size_t end = 1; end < noise.size(); ++end) {
    double sum = noise[end].variance;
    std::size_t first = end;
    double mean = sum;
    while (first > 0 && noise[first - 1].variance > mean) {
      sum += noise[--first].variance;
      mean = sum / static_cast<double>(end + 1 - first);
    }
    for (std::size_t i = first; i <= end; ++i) noise[i].variance = mean;
  }
}

double varianceAt(const std::vector<NoiseAtRange>& noise, double range) {
  const auto next =
      std::upper_bound(noise.begin(), noise.end(), NoiseAtRange{range, 0.0}, isNearer);
  if (next == noise.begin()) return next->variance;
  const auto before = std::prev(next);
  if (next == noise.end()) return before->variance;
  const double share = (range - before->range) / (next->range - before->range);
  return before->variance + share * (next->variance - before->variance);
}

}  // namespace

std::vector<NoiseAtRange> estimateNoise(const Scan& scan) {
  std::vector<NoiseAtRange> runs = noiseOfRuns(scan);
  if (runs.size() < kFewestRuns) return {};
  std::sort(runs.begin(), runs.end(), isNearer);
  const std::size_t groups = std::clamp<std::size_t>(runs.size() / kRunsOfGroup, 1, kMostGroups);
  std::vector<NoiseAtRange> noise;
  for (std::size_t k = 0; k < groups; ++k) {
    const auto at = [&](std::size_t group) {
      return runs.begin() + static_cast<std::ptrdiff_t>(group * runs.size() / groups);
    };
    noise.push_back(medianOf(at(k), at(k + 1)));
  }
  makeMonotonic(noise);
  return noise;
}

void raiseToEstimate(Scan& scan) {
  const std::vector<NoiseAtRange> noise = estimateNoise(scan);
  if (noise.empty()) return;
  std::vector<double> variances = scan.rangeVariances();
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    variances[i] = std::max(variances[i], varianceAt(noise, scan.ranges()[i]));
  }
  scan.setRangeVariances(std::move(variances));
}

}  // namespace sightline::scan
