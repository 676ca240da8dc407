#include "sightline/dead_reckoning/angle_histogram.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/angle.h"
#include "sightline/geometry/parabola.h"

namespace sightline::dead_reckoning {

namespace {

// S(k), with k = 0 where both are alike.
double correlationAt(const std::vector<double>& reference, const std::vector<double>& scan,
                     long shift) {
  const long bins = static_cast<long>(reference.size());
  const auto offset = static_cast<std::size_t>(((shift % bins) + bins) % bins);
  double sum = 0.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const std::size_t j = i + offset;
    sum += scan[i] * reference[j < scan.size() ? j : j - scan.size()];
  }
  return sum;
}

// Counts spread over neighbouring bins: a direction has noise, too.
std::vector<double> smoothed(const std::vector<double>& counts) {
  const std::size_t n = counts.size();
  std::vector<double> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    result[i] = 0.25 * counts[(i + n - 1) % n] + 0.5 * counts[i] + 0.25 * counts[(i + 1) % n];
  }
  return result;
}

// Peak near a value that neither of its neighbours exceeds, in steps from it.
double peakOffset(double before, double here, double after) {
  const auto lowest = geometry::lowestPoint(-before, -here, -after);
  return lowest ? lowest->offset : 0.0;
}

}  // namespace

std::vector<double> angleHistogram(const std::vector<SurfacePoint>& points, std::size_t skip,
                                   std::size_t bins) {
  std::vector<double> counts(bins, 0.0);
  const double per_radian = static_cast<double>(bins) / geometry::kPi;
  for (std::size_t i = skip; i < points.size(); ++i) {
    const Eigen::Vector2d along = points[i].position - points[i - skip].position;
    if (along.isZero(0.0)) continue;
    const double angle = geometry::wrapOrientation(std::atan2(along.y(), along.x()));
    const auto bin = static_cast<std::size_t>((angle + 0.5 * geometry::kPi) * per_radian);
    counts[std::min(bin, bins - 1)] += 1.0;
  }
  return smoothed(counts);
}

std::vector<HeadingCandidate> correlateHistograms(const std::vector<double>& reference,
                                                  const std::vector<double>& scan, double centre,
                                                  double half_width) {
  const double bin = geometry::kPi / static_cast<double>(reference.size());
  const long first = std::lround((centre - half_width) / bin);
  const long last = std::lround((centre + half_width) / bin);
  std::vector<HeadingCandidate> candidates;
  double before = correlationAt(reference, scan, first - 1);
  double here = correlationAt(reference, scan, first);
  for (long k = first; k <= last; ++k) {
    const double after = correlationAt(reference, scan, k + 1);
    if (here > 0.0 && here >= before && here > after) {
      const double shift = static_cast<double>(k) + peakOffset(before, here, after);
      candidates.push_back({geometry::wrapAngle(shift * bin), here});
    }
    before = here;
    here = after;
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const HeadingCandidate& a, const HeadingCandidate& b) {
              return a.correlation > b.correlation;
            });
  return candidates;
}

}  // namespace sightline::dead_reckoning
