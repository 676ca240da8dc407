#include "sightline/dead_reckoning/submap_matcher.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "sightline/dead_reckoning/pose_difference.h"
#include "sightline/dead_reckoning/surprise.h"

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;
using geometry::UncertainPose2;

struct MatchTuning {
  // Windows in which the local match finds its way from the middle [m, rad].
  double narrow_position = 0.4;
  double narrow_heading = 0.35;
  // A local match that speaks as clearly as this is taken without looking further.
  double clear_cost = 0.2;
  double clear_contradictions = 0.1;
  // In windows up to this ratio wider, it has to speak more clearly, and be within half of a narrow
  // window from the prediction.
  double moderate = 2.0;
  double moderate_clearness = 0.5;
  // Least inliers of a match that the prediction leads to. Twice as many turn the Intel log by 28°
  // more in all and add .8 points of bad steps.
  double least_inliers = 0.25;
  double few_contradictions = 0.1;
  // Squared Mahalanobis distance from the prior that is near.
  double near_prior = 25.0;
  // The search looks at least this far about a prediction that misled the local match [m, rad].
  double least_position = 0.3;
  double least_heading = 0.3;
  // Candidates of a search, and where the window is narrow.
  std::size_t candidates = 8;
  std::size_t narrow_candidates = 3;
  // Scales of the loss at first, from the prediction and from a candidate [m].
  double local_scale = 0.2;
  double search_scale = 0.3;
  // Fewer points than this say nothing.
  std::size_t fewest_points = 20;
  // Two poses further apart than this are two explanations [m, rad], ambiguous where their costs
  // are this near; refining one of two that are nearer than the second pair leads to the other.
  double distinct_position = 0.15;
  double distinct_heading = 0.06;
  double neighbour_position = 0.25;
  double neighbour_heading = 0.1;
  double cost_gap = 0.05;
  // A second explanation that is less expected by more than this costs is no rival: six nats.
  double surprise_gap = 0.075;
  // A pose is alone where the reference knows this share of the scan, what it knows is explained
  // and not contradicted to these, and no other explanation costs little more.
  double alone_known = 0.3;
  double alone_cost = 0.45;
  double alone_contradictions = 0.3;
  double alone_gap = 0.1;
  // Roughness of surfaces over the noise of a beam, as the surfaces were seen by such beams.
  double roughness_per_sigma = 0.67;
  // Scans in a row, fitting a fresh reference alone, after which it becomes the reference.
  int trusted_after = 3;
};
constexpr MatchTuning kMatch{};

bool isDistinct(const Pose2& a, const Pose2& b) {
  const Eigen::Vector3d off = difference(a, b);
  return off.head<2>().norm() > kMatch.distinct_position ||
         std::abs(off[2]) > kMatch.distinct_heading;
}

bool isNeighbour(const Pose2& a, const Pose2& b) {
  const Eigen::Vector3d off = difference(a, b);
  return off.head<2>().norm() < kMatch.neighbour_position &&
         std::abs(off[2]) < kMatch.neighbour_heading;
}

double squaredDistance(const Pose2& pose, const UncertainPose2& prior) {
  const Eigen::Vector3d off = difference(pose, prior.mean);
  return off.dot(prior.covariance.inverse() * off);
}

bool isNear(const Pose2& pose, const UncertainPose2& prior) {
  return squaredDistance(pose, prior) < kMatch.near_prior;
}

// Whether a scan goes into the reference that is trusted. One that is the first to look where it
// looks was located by others.
bool belongsToTrusted(MatchState state) {
  return state == MatchState::kMatched || state == MatchState::kRecovered ||
         state == MatchState::kInitial;
}

bool isNarrow(const SearchWindow& window) {
  return window.isWithin(kMatch.narrow_position, kMatch.narrow_heading);
}

bool isAtTheMiddle(const Pose2& pose, const SearchWindow& window) {
  const Eigen::Vector3d off = difference(pose, window.centre);
  return off.head<2>().norm() < 0.5 * kMatch.narrow_position &&
         std::abs(off.z()) < 0.5 * kMatch.narrow_heading;
}

}  // namespace

MatchOutcome SubmapMatcher::match(const SurfaceScan& surfaces, const UncertainPose2& prior,
                                  const SearchWindow& window) const {
  const Task task{surfaces, RangeProfile(surfaces), prior, window};
  MatchOutcome first = matchWith(trusted_, task);
  if (fresh_.empty()) return first;
  const bool is_matched = first.state == MatchState::kMatched;
  if (is_matched && isExpected(first, task)) return first;
  MatchOutcome second = matchWith(fresh_, task);
  if (is_matched && !isExplainedBetter(second, first)) {
    // The scans before were bridged; if that went wrong, this pose is a jump.
    if (isDistinct(second.T_odom_base, first.T_odom_base)) first.state = MatchState::kRecovered;
    return first;
  }
  if (second.state != MatchState::kMatched) return first;
  second.evaluations += first.evaluations;
  second.reference.is_fresh = true;
  return second;
}

bool SubmapMatcher::isExpected(const MatchOutcome& outcome, const Task& task) {
  return isNear(outcome.T_odom_base, task.prior) &&
         !isDistinct(outcome.T_odom_base, task.prior.mean);
}

// Tells whether the second reference explains a scan, and so much better that the first one is
// likely to have found a place that only looks alike.
bool SubmapMatcher::isExplainedBetter(const MatchOutcome& second, const MatchOutcome& first) {
  return second.state == MatchState::kMatched && second.cost + kMatch.alone_gap < first.cost;
}

double SubmapMatcher::learn(const SurfaceScan& surfaces, const Pose2& T_odom_base,
                            const MatchOutcome& outcome) {
  if (surfaces.points.size() < kMatch.fewest_points) return 0.0;
  if (trusted_.empty()) return trusted_.add(surfaces, T_odom_base, config_);
  if (outcome.reference.is_fresh) {
    const double added = fresh_.add(surfaces, T_odom_base, config_);
    if (++fresh_matches_ >= kMatch.trusted_after) {
      trusted_ = std::move(fresh_);
      fresh_ = {};
    }
    return added;
  }
  fresh_matches_ = 0;
  if (belongsToTrusted(outcome.state)) {
    fresh_ = {};
    return trusted_.add(surfaces, T_odom_base, config_);
  }
  // A scanner whose view the second reference lacks says nothing against it.
  if (fresh_.isSeenBy(surfaces.scanner)) fresh_ = {};
  return fresh_.add(surfaces, T_odom_base, config_);
}

MatchOutcome SubmapMatcher::matchWith(const Reference& reference, const Task& task) const {
  if (task.surfaces.points.size() < kMatch.fewest_points) return {};
  std::vector<Hypothesis> hypotheses;
  if (task.window.isWithin(kMatch.moderate * kMatch.narrow_position,
                           kMatch.moderate * kMatch.narrow_heading)) {
    hypotheses.push_back(refine(reference.submap(), task, task.window.centre, kMatch.local_scale));
    if (isBeyondDoubt(hypotheses.back(), task)) return conclude(hypotheses, task);
  }
  return matchWidely(reference, task, std::move(hypotheses));
}

// Tells whether nothing else needs to be looked for.
bool SubmapMatcher::isBeyondDoubt(const Hypothesis& local, const Task& task) {
  const bool is_narrow = isNarrow(task.window);
  const double clearness = is_narrow ? 1.0 : kMatch.moderate_clearness;
  const Pose2& pose = local.match.T_odom_base;
  return local.evidence.cost < clearness * kMatch.clear_cost &&
         local.evidence.contradictions < clearness * kMatch.clear_contradictions &&
         isNear(pose, task.prior) && (is_narrow || isAtTheMiddle(pose, task.window));
}

MatchOutcome SubmapMatcher::matchWidely(const Reference& reference, const Task& task,
                                        std::vector<Hypothesis> hypotheses) const {
  const Task wide = widened(task);
  const SearchRasters& rasters = reference.rastersAbout(task.window.centre.translation());
  const std::size_t most = isNarrow(task.window) ? kMatch.narrow_candidates : kMatch.candidates;
  const SearchResult found = searchRasters(task.surfaces.points, rasters, wide.window,
                                           wide.prior.covariance.diagonal().cwiseSqrt(), most);
  std::vector<Hypothesis> candidates;
  for (const SearchCandidate& candidate : found.candidates) {
    const bool known =
        std::any_of(candidates.begin(), candidates.end(), [&](const Hypothesis& hypothesis) {
          return isNeighbour(hypothesis.match.T_odom_base, candidate.T_odom_base);
        });
    if (known) continue;
    candidates.push_back(
        refine(reference.submap(), wide, candidate.T_odom_base, kMatch.search_scale));
  }
  for (Hypothesis& candidate : candidates) hypotheses.push_back(std::move(candidate));
  MatchOutcome outcome = conclude(hypotheses, task);
  outcome.evaluations += found.evaluations;
  return outcome;
}

// A prediction that misled is believed as far as the window goes.
SubmapMatcher::Task SubmapMatcher::widened(const Task& task) {
  Task wide = task;
  wide.window.position = std::max(task.window.position, kMatch.least_position);
  wide.window.heading = std::max(task.window.heading, kMatch.least_heading);
  const double position = kMatch.least_position / 3.0;
  const double heading = kMatch.least_heading / 3.0;
  wide.prior.covariance +=
      Eigen::Vector3d(position * position, position * position, heading * heading).asDiagonal();
  return wide;
}

SubmapMatcher::Hypothesis SubmapMatcher::refine(const Submap& submap, const Task& task,
                                                const Pose2& start, double scale) const {
  Hypothesis hypothesis;
  const double roughness = kMatch.roughness_per_sigma * task.surfaces.sigma;
  const LineMatcher lines(std::max(config_.surface_sigma, roughness));
  hypothesis.match = lines.match(task.surfaces, submap, start, task.prior, scale);
  hypothesis.evidence = weigh(hypothesis.match, task.surfaces, task.profile, submap);
  const double square = squaredDistance(hypothesis.match.T_odom_base, task.prior);
  hypothesis.cost = hypothesis.evidence.cost + surpriseCost(square);
  return hypothesis;
}

// A match that the prediction leads to is believed as long as next to nothing speaks against it:
// beyond a door most of a scan is new.
bool SubmapMatcher::isClear(const Hypothesis& hypothesis, bool predicted) const {
  const Evidence& evidence = hypothesis.evidence;
  if (predicted && evidence.inliers > kMatch.least_inliers &&
      evidence.contradictions < kMatch.few_contradictions) {
    return true;
  }
  return evidence.cost < config_.max_cost && evidence.contradictions < config_.max_contradictions;
}

// After a turn or a gap most of a scan is unseen: the right pose is the one that alone explains
// what the reference knows of it.
bool SubmapMatcher::isAlone(const std::vector<Hypothesis>& hypotheses) {
  const Hypothesis& best = hypotheses.front();
  const Evidence& evidence = best.evidence;
  if (evidence.known < kMatch.alone_known || evidence.known_cost > kMatch.alone_cost ||
      evidence.contradictions > kMatch.alone_contradictions) {
    return false;
  }
  return std::none_of(hypotheses.begin() + 1, hypotheses.end(), [&](const Hypothesis& other) {
    return other.cost < best.cost + kMatch.alone_gap &&
           isDistinct(other.match.T_odom_base, best.match.T_odom_base);
  });
}

// Of those that mean the same pose, the one that fits best goes first: the prior, which pulls at
// each, chooses between explanations alone.
void SubmapMatcher::putBestFirst(std::vector<Hypothesis>& hypotheses) {
  std::sort(hypotheses.begin(), hypotheses.end(),
            [](const Hypothesis& a, const Hypothesis& b) { return a.cost < b.cost; });
  const Pose2 pose = hypotheses.front().match.T_odom_base;
  for (Hypothesis& other : hypotheses) {
    if (other.evidence.cost < hypotheses.front().evidence.cost &&
        !isDistinct(other.match.T_odom_base, pose)) {
      std::swap(other, hypotheses.front());
    }
  }
}

MatchOutcome SubmapMatcher::conclude(std::vector<Hypothesis>& hypotheses, const Task& task) const {
  MatchOutcome outcome;
  outcome.evaluations = hypotheses.size();
  if (hypotheses.empty()) return outcome;
  putBestFirst(hypotheses);
  const Hypothesis& best = hypotheses.front();
  outcome.T_odom_base = best.match.T_odom_base;
  const ResidualStatistics residuals = residualStatistics(best.match);
  const double factor = residuals.factor();
  outcome.information = best.match.information / factor;
  outcome.motion_gradient = best.match.motion_gradient / (factor * factor);
  outcome.common = residuals.common();
  outcome.inliers = best.evidence.inliers;
  outcome.known = best.evidence.known;
  outcome.cost = best.evidence.cost;
  const bool predicted = isNarrow(task.window) && isNear(outcome.T_odom_base, task.prior);
  const bool is_taken = isClear(best, predicted) || isAlone(hypotheses);
  outcome.state = is_taken ? MatchState::kMatched : MatchState::kFailed;
  for (const Hypothesis& other : hypotheses) {
    const bool is_rival = other.evidence.cost <= best.evidence.cost + kMatch.cost_gap &&
                          other.cost <= best.cost + kMatch.surprise_gap;
    if (!is_rival || !isDistinct(other.match.T_odom_base, outcome.T_odom_base)) continue;
    const Eigen::Vector3d off = difference(other.match.T_odom_base, outcome.T_odom_base);
    outcome.extra_covariance +=
        probabilityBeside(other.evidence.cost - best.evidence.cost) * off * off.transpose();
    if (outcome.state == MatchState::kMatched) outcome.state = MatchState::kAmbiguous;
  }
  return outcome;
}

}  // namespace sightline::dead_reckoning
