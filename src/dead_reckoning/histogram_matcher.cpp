#include "sightline/dead_reckoning/histogram_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sightline/dead_reckoning/pose_space.h"
#include "sightline/geometry/angle.h"

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

// A scan whose points are on average this share of D away is not explained.
constexpr double kMaxCost = 0.4;
// The reference is held while the points are on average nearer than this share of D.
constexpr double kHeldCost = 0.15;
// Headings this near are one candidate [rad].
constexpr double kSameHeading = 0.02;
// Error of a point: the translation is a multiple of the resolution, the heading of a bin; shared
// by all points, and so much larger than of one [m].
constexpr double kPointSigma = 0.3;
// The field is drawn for squares up to this half side [m].
constexpr double kWidest = 1.28;
// Cells above this are wide [m]; D and what does not count, as shares of a wide cell.
constexpr double kWideCell = 0.1;
constexpr double kTruncationPerCell = 1.5;
constexpr double kSlackPerCell = 0.4;

std::vector<Eigen::Vector2d> turned(const Sweep& sweep, double heading) {
  const Eigen::Matrix2d rotation = Pose2(0.0, 0.0, heading).rotation();
  std::vector<Eigen::Vector2d> points;
  for (const SurfacePoint& point : sweep.points) points.push_back(rotation * point.position);
  return points;
}

// The half side of the search: a whole number of halvings above the resolution.
double halfSide(double position, double resolution) {
  const double cells = std::max(1.0, position / (2.0 * resolution));
  return 2.0 * resolution * std::exp2(std::ceil(std::log2(cells)));
}

}  // namespace

double fieldDistance(double max_distance, double half) {
  constexpr double kFirstCell = 0.5;  // of half the side
  return std::max(max_distance, kTruncationPerCell * kFirstCell * half);
}

CellCost translationCost(const DistanceField& field, const std::vector<Eigen::Vector2d>& points,
                         double max_distance) {
  return [&field, &points, max_distance](const Eigen::Vector2d& position, double cell) {
    return field.cost(points, position, std::max(max_distance, kTruncationPerCell * cell),
                      cell > kWideCell ? kSlackPerCell * cell : 0.0);
  };
}

std::vector<std::vector<double>> HistogramMatcher::histograms(const Sweep& sweep) const {
  const auto bins = static_cast<std::size_t>(std::lround(geometry::kPi / config_.bin));
  std::vector<std::vector<double>> all;
  for (const double step : config_.steps) {
    const double beams = geometry::radians(step) / std::max(sweep.beam_angle, 1e-4);
    const auto skip = static_cast<std::size_t>(std::max(1L, std::lround(beams)));
    all.push_back(angleHistogram(sweep.points, skip, bins));
  }
  return all;
}

std::vector<HeadingCandidate> HistogramMatcher::headings(const Sweep& sweep, double centre,
                                                         double half_width) const {
  const auto scan = histograms(sweep);
  std::vector<HeadingCandidate> candidates;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    auto found = correlateHistograms(reference_histograms_[i], scan[i], centre, half_width);
    if (found.empty()) continue;
    // Step sizes count alike.
    const double best = found.front().correlation;
    for (HeadingCandidate& candidate : found) candidate.correlation /= best;
    candidates.insert(candidates.end(), found.begin(), found.end());
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const HeadingCandidate& a, const HeadingCandidate& b) {
                     return a.correlation > b.correlation;
                   });
  std::vector<HeadingCandidate> chosen;
  for (const HeadingCandidate& candidate : candidates) {
    if (chosen.size() == static_cast<std::size_t>(config_.candidates)) break;
    const bool known = std::any_of(chosen.begin(), chosen.end(), [&](const auto& other) {
      return std::abs(geometry::wrapAngle(other.heading - candidate.heading)) < kSameHeading;
    });
    if (!known) chosen.push_back(candidate);
  }
  return chosen;
}

MatchOutcome HistogramMatcher::match(const Sweep& sweep, const geometry::UncertainPose2& prior,
                                     const SearchWindow& window) {
  hold_ = false;
  MatchOutcome outcome;
  outcome.searched = true;
  outcome.T_odom_base = prior.mean;
  const Pose2 centre = geometry::between(*T_odom_reference_, window.centre);
  const double half = halfSide(window.position, config_.resolution);
  double best_cost = std::numeric_limits<double>::infinity();
  for (const HeadingCandidate& heading : headings(sweep, centre.theta(), window.heading)) {
    const auto points = turned(sweep, heading.heading);
    const Minimum minimum = searchIteratively(translationCost(field_, points, config_.max_distance),
                                              centre.translation(), half, config_.resolution);
    if (minimum.cost >= best_cost) continue;
    best_cost = minimum.cost;
    outcome.T_odom_base = *T_odom_reference_ * Pose2(minimum.position, heading.heading);
  }
  if (best_cost > kMaxCost) return outcome;
  hold_ = best_cost < kHeldCost;
  outcome.state = MatchState::kMatched;
  outcome.inliers = 1.0 - best_cost;
  outcome.information = surfaceInformation(sweep, outcome.T_odom_base, kPointSigma);
  return outcome;
}

double HistogramMatcher::learn(const Sweep& sweep, const Pose2& T_odom_base, MatchState) {
  if ((T_odom_reference_ && hold_) || sweep.points.empty()) return 0.0;
  T_odom_reference_ = T_odom_base;
  reference_histograms_ = histograms(sweep);
  field_.draw(sweep.points, fieldDistance(config_.max_distance, kWidest));
  return 1.0;
}

}  // namespace sightline::dead_reckoning
