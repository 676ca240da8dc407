#include "sightline/dead_reckoning/histogram_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sightline/dead_reckoning/motion_gradient.h"
#include "sightline/geometry/angle.h"

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

struct HistogramTuning {
  // Mean distance of the points as a share of D (eq. 4.8): above `max_cost` a scan is not
  // explained, below `held_cost` the reference is kept. Chosen by hand.
  double max_cost = 0.4;
  double held_cost = 0.15;
  // Headings this near are one candidate [rad].
  double same_heading = 0.02;
  // Error of a point [m]: the translation is a multiple of the resolution, the heading of a bin,
  // and all points share their errors, which makes it much larger than that of one.
  double point_sigma = 0.2;
  // Half side of the square that the field is drawn for, and of the largest that is searched [m].
  double widest = 1.28;
  double widest_search = 24.0;
  // Cells above this are wide [m]; D, and the distance that does not count, as shares of a wide
  // cell.
  double wide_cell = 0.1;
  double truncation_per_cell = 1.5;
  double slack_per_cell = 0.4;
};
constexpr HistogramTuning kHistogram{};

std::vector<Eigen::Vector2d> turned(const SurfaceScan& surfaces, double heading) {
  const Eigen::Matrix2d rotation = Pose2(0.0, 0.0, heading).rotation();
  std::vector<Eigen::Vector2d> points;
  for (const SurfacePoint& point : surfaces.points) points.push_back(rotation * point.position);
  return points;
}

// The half side of the search: a whole number of halvings above the resolution.
double halfSide(double position, double resolution) {
  const double cells = std::max(1.0, position / (2.0 * resolution));
  return 2.0 * resolution * std::exp2(std::ceil(std::log2(cells)));
}

}  // namespace

double fieldDistance(double max_distance, double half) {
  constexpr double kFirstCell = 0.5;  // as a share of half the side
  return std::max(max_distance, kHistogram.truncation_per_cell * kFirstCell * half);
}

CellCost translationCost(const DistanceField& field, const std::vector<Eigen::Vector2d>& points,
                         double max_distance) {
  return [&field, &points, max_distance](const Eigen::Vector2d& position, double cell) {
    return field.cost(points, position,
                      std::max(max_distance, kHistogram.truncation_per_cell * cell),
                      cell > kHistogram.wide_cell ? kHistogram.slack_per_cell * cell : 0.0);
  };
}

std::vector<std::vector<double>> HistogramMatcher::histograms(const SurfaceScan& surfaces) const {
  const auto bins = static_cast<std::size_t>(std::lround(geometry::kPi / config_.bin));
  std::vector<std::vector<double>> all;
  for (const double step : config_.steps) {
    const double beams = geometry::radians(step) / std::max(surfaces.beam_angle, 1e-4);
    const auto skip = static_cast<std::size_t>(std::max(1L, std::lround(beams)));
    all.push_back(angleHistogram(surfaces.points, skip, bins));
  }
  return all;
}

std::vector<HeadingCandidate> HistogramMatcher::headings(const SurfaceScan& surfaces, double centre,
                                                         double half_width) const {
  const auto scan = histograms(surfaces);
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
      return std::abs(geometry::wrapAngle(other.heading - candidate.heading)) <
             kHistogram.same_heading;
    });
    if (!known) chosen.push_back(candidate);
  }
  return chosen;
}

MatchOutcome HistogramMatcher::match(const SurfaceScan& surfaces,
                                     const geometry::UncertainPose2& prior,
                                     const SearchWindow& window) const {
  MatchOutcome outcome;
  outcome.T_odom_base = prior.mean;
  const Pose2 centre = geometry::between(*T_odom_reference_, window.centre);
  const double half =
      halfSide(std::min(window.position, kHistogram.widest_search), config_.resolution);
  double best_cost = std::numeric_limits<double>::infinity();
  for (const HeadingCandidate& heading : headings(surfaces, centre.theta(), window.heading)) {
    const auto points = turned(surfaces, heading.heading);
    const Minimum minimum = searchIteratively(translationCost(field_, points, config_.max_distance),
                                              centre.translation(), half, config_.resolution);
    outcome.evaluations += minimum.evaluations;
    if (minimum.cost >= best_cost) continue;
    best_cost = minimum.cost;
    outcome.T_odom_base = *T_odom_reference_ * Pose2(minimum.position, heading.heading);
  }
  if (best_cost > kHistogram.max_cost) return outcome;
  outcome.reference.is_held = best_cost < kHistogram.held_cost;
  outcome.state = MatchState::kMatched;
  outcome.inliers = 1.0 - best_cost;
  outcome.cost = best_cost;
  outcome.information = surfaceInformation(surfaces, outcome.T_odom_base, kHistogram.point_sigma);
  outcome.motion_gradient =
      surfaceMotionGradient(surfaces, outcome.T_odom_base, kHistogram.point_sigma);
  return outcome;
}

double HistogramMatcher::learn(const SurfaceScan& surfaces, const Pose2& T_odom_base,
                               const MatchOutcome& outcome) {
  const bool is_kept = T_odom_reference_ && outcome.reference.is_held;
  if (is_kept || surfaces.points.empty()) return 0.0;
  T_odom_reference_ = T_odom_base;
  reference_histograms_ = histograms(surfaces);
  field_.draw(surfaces.points, fieldDistance(config_.max_distance, kHistogram.widest));
  return 1.0;
}

}  // namespace sightline::dead_reckoning
