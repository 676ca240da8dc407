#include "sightline/dead_reckoning/submap_matcher.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;
using geometry::UncertainPose2;

// Windows in which the local match finds its way from the middle.
constexpr double kNarrowPosition = 0.4;  // [m]
constexpr double kNarrowHeading = 0.35;  // [rad]
// A local match that speaks as clearly as this is taken without looking further.
constexpr double kClearCost = 0.2;
constexpr double kClearContradictions = 0.1;
constexpr double kLeastInliers = 0.25;
constexpr double kFewContradictions = 0.1;
constexpr double kNearPrior = 25.0;  // squared Mahalanobis distance
// The search looks at least this far about a prediction that misled the local match.
constexpr double kLeastPosition = 0.3;  // [m]
constexpr double kLeastHeading = 0.3;   // [rad]
constexpr std::size_t kCandidates = 8;
constexpr std::size_t kNarrowCandidates = 3;  // where the window is narrow
constexpr double kLocalScale = 0.2;           // [m]
constexpr double kSearchScale = 0.3;          // [m]
// Fewer points than this say nothing.
constexpr std::size_t kEvidence = 20;
// Two poses further apart than this are two explanations, and ambiguous where their costs are this
// near.
constexpr double kDistinctPosition = 0.15;  // [m]
constexpr double kDistinctHeading = 0.06;   // [rad]
constexpr double kNeighbourPosition = 0.25;
constexpr double kNeighbourHeading = 0.1;
constexpr double kCostGap = 0.05;
// So many scans that fit a fresh reference alone make it the one.
constexpr int kTrusted = 3;

Eigen::Vector3d difference(const Pose2& a, const Pose2& b) {
  Eigen::Vector3d off = a.coordinates() - b.coordinates();
  off[2] = geometry::wrapAngle(off[2]);
  return off;
}

bool isDistinct(const Pose2& a, const Pose2& b) {
  const Eigen::Vector3d off = difference(a, b);
  return off.head<2>().norm() > kDistinctPosition || std::abs(off[2]) > kDistinctHeading;
}

// Whether refining one would lead to the other.
bool isNeighbour(const Pose2& a, const Pose2& b) {
  const Eigen::Vector3d off = difference(a, b);
  return off.head<2>().norm() < kNeighbourPosition && std::abs(off[2]) < kNeighbourHeading;
}

bool isNear(const Pose2& pose, const UncertainPose2& prior) {
  const Eigen::Vector3d off = difference(pose, prior.mean);
  return off.dot(prior.covariance.inverse() * off) < kNearPrior;
}

bool isNarrow(const SearchWindow& window) {
  return window.position < kNarrowPosition && window.heading < kNarrowHeading;
}

}  // namespace

void SubmapMatcher::clear() {
  trusted_ = {};
  fresh_ = {};
}

MatchOutcome SubmapMatcher::match(const Sweep& sweep, const UncertainPose2& prior,
                                  const SearchWindow& window) {
  matched_fresh_ = false;
  MatchOutcome outcome = matchWith(trusted_, sweep, prior, window);
  if (fresh_.submap.empty()) return outcome;
  if (outcome.state == MatchState::kMatched) {
    // The scans before were bridged; if that went wrong, this pose is a jump.
    if (!isNear(outcome.T_odom_base, prior) || isDistinct(outcome.T_odom_base, prior.mean)) {
      const MatchOutcome other = matchWith(fresh_, sweep, prior, window);
      if (isDistinct(other.T_odom_base, outcome.T_odom_base))
        outcome.state = MatchState::kRecovered;
    }
    return outcome;
  }
  const MatchOutcome fresh = matchWith(fresh_, sweep, prior, window);
  if (fresh.state != MatchState::kMatched) return outcome;
  matched_fresh_ = true;
  return fresh;
}

double SubmapMatcher::learn(const Sweep& sweep, const Pose2& T_odom_base, MatchState state) {
  if (sweep.points.size() < kEvidence) return 0.0;
  if (trusted_.submap.empty()) return addKeyframe(trusted_, sweep, T_odom_base);
  if (matched_fresh_) {
    const double added = addKeyframe(fresh_, sweep, T_odom_base);
    if (++fresh_matches_ >= kTrusted) {
      trusted_ = std::move(fresh_);
      fresh_ = {};
    }
    return added;
  }
  fresh_matches_ = 0;
  if (state == MatchState::kMatched || state == MatchState::kRecovered) {
    if (!fresh_.submap.empty()) fresh_ = {};
    return addKeyframe(trusted_, sweep, T_odom_base);
  }
  fresh_ = {};
  return addKeyframe(fresh_, sweep, T_odom_base);
}

double SubmapMatcher::addKeyframe(Reference& reference, const Sweep& sweep,
                                  const Pose2& T_odom_base) {
  const Pose2 way = geometry::between(reference.keyframe, T_odom_base);
  if (!reference.submap.empty() && way.translation().norm() < config_.spacing &&
      std::abs(way.theta()) < config_.turn_spacing) {
    return 0.0;
  }
  reference.keyframe = T_odom_base;
  return reference.submap.add(T_odom_base, sweep, static_cast<std::size_t>(config_.keyframes));
}

MatchOutcome SubmapMatcher::matchWith(Reference& reference, const Sweep& sweep,
                                      const UncertainPose2& prior, const SearchWindow& window) {
  if (sweep.points.size() < kEvidence) return {};
  const RangeProfile profile(sweep);
  std::vector<Hypothesis> hypotheses;
  if (isNarrow(window)) {
    hypotheses.push_back(
        refine(reference.submap, sweep, profile, window.centre, prior, kLocalScale));
    const Hypothesis& local = hypotheses.back();
    if (local.evidence.cost < kClearCost && local.evidence.contradictions < kClearContradictions &&
        isNear(local.match.T_odom_base, prior)) {
      return conclude(hypotheses, prior, window);
    }
  }
  for (Hypothesis& found : search(reference, sweep, profile, prior, window)) {
    hypotheses.push_back(std::move(found));
  }
  MatchOutcome outcome = conclude(hypotheses, prior, window);
  outcome.searched = true;
  return outcome;
}

std::vector<SubmapMatcher::Hypothesis> SubmapMatcher::search(Reference& reference,
                                                             const Sweep& sweep,
                                                             const RangeProfile& profile,
                                                             const UncertainPose2& prior,
                                                             const SearchWindow& window) {
  SearchWindow wide = window;
  wide.position = std::max(window.position, kLeastPosition);
  wide.heading = std::max(window.heading, kLeastHeading);
  // A prediction that misled is believed as far as the window goes.
  UncertainPose2 doubted = prior;
  const double position = kLeastPosition / 3.0;
  const double heading = kLeastHeading / 3.0;
  doubted.covariance +=
      Eigen::Vector3d(position * position, position * position, heading * heading).asDiagonal();
  std::vector<Hypothesis> hypotheses;
  const std::size_t most = isNarrow(window) ? kNarrowCandidates : kCandidates;
  for (const SearchCandidate& candidate :
       reference.search.search(sweep.points, reference.submap, wide, most)) {
    const bool known =
        std::any_of(hypotheses.begin(), hypotheses.end(), [&](const Hypothesis& hypothesis) {
          return isNeighbour(hypothesis.match.T_odom_base, candidate.T_odom_base);
        });
    if (known) continue;
    hypotheses.push_back(
        refine(reference.submap, sweep, profile, candidate.T_odom_base, doubted, kSearchScale));
  }
  return hypotheses;
}

SubmapMatcher::Hypothesis SubmapMatcher::refine(const Submap& submap, const Sweep& sweep,
                                                const RangeProfile& profile, const Pose2& start,
                                                const UncertainPose2& prior, double scale) {
  Hypothesis hypothesis;
  hypothesis.match = lines_.match(sweep.points, submap, start, prior, scale);
  hypothesis.evidence = weigh(hypothesis.match, sweep, profile, submap);
  return hypothesis;
}

// Where the prediction leads is a place to believe in, as long as next to nothing speaks against
// it: beyond a door most of a scan is new.
bool SubmapMatcher::isClear(const Hypothesis& hypothesis, bool predicted) const {
  const Evidence& evidence = hypothesis.evidence;
  if (predicted && evidence.inliers > kLeastInliers &&
      evidence.contradictions < kFewContradictions) {
    return true;
  }
  return evidence.cost < config_.max_cost && evidence.contradictions < config_.max_contradictions;
}

MatchOutcome SubmapMatcher::conclude(std::vector<Hypothesis>& hypotheses,
                                     const UncertainPose2& prior,
                                     const SearchWindow& window) const {
  MatchOutcome outcome;
  if (hypotheses.empty()) return outcome;
  std::sort(hypotheses.begin(), hypotheses.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.evidence.cost < b.evidence.cost;
  });
  const Hypothesis& best = hypotheses.front();
  outcome.T_odom_base = best.match.T_odom_base;
  const ResidualSpread spread = spreadOf(best.match);
  outcome.information = best.match.information / spread.factor();
  outcome.common = spread.common();
  outcome.inliers = best.evidence.inliers;
  const bool predicted = isNarrow(window) && isNear(outcome.T_odom_base, prior);
  outcome.state = isClear(best, predicted) ? MatchState::kMatched : MatchState::kFailed;
  for (const Hypothesis& other : hypotheses) {
    if (other.evidence.cost > best.evidence.cost + kCostGap) break;
    if (!isDistinct(other.match.T_odom_base, outcome.T_odom_base)) continue;
    const Eigen::Vector3d off = difference(other.match.T_odom_base, outcome.T_odom_base);
    outcome.spread += off * off.transpose();
    if (outcome.state == MatchState::kMatched) outcome.state = MatchState::kAmbiguous;
  }
  return outcome;
}

}  // namespace sightline::dead_reckoning
