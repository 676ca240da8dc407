#include "sightline/mapping/path_adjuster.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sightline::mapping {

namespace {

using geometry::Pose2;

constexpr struct {
  // A place is the same within this [m], more where the path may have drifted.
  double radius = 2.0;
  // Drift of dead reckoning since the last loop that is looked for: share of the way, rad/m, and
  // the most of both [m, rad].
  double drift = 0.03;
  double turn_drift = 0.004;
  double most_drift = 8.0;
  double most_turn_drift = 0.6;
  std::size_t most_visits = 3;
  std::size_t every = 2;        // key scan is compared on the way forward
  std::size_t between = 25;     // loops from one adjustment to the next
  double surprise = 0.5;        // a loop as far from the estimate as this waits for others [m]
  double surprise_turn = 0.15;  // [rad]
  std::size_t witnesses = 3;    // that have to say the same, from so far apart [m]
  double witness_way = 0.9;
  int rounds = 2;
  double most_cost = 16.0;  // squared Mahalanobis distance of a relation that agrees, of 3
} kAdjust{};

}  // namespace

PathAdjuster::PathAdjuster(const std::vector<KeyScan>& keys, Progress progress)
    : keys_(keys), progress_(std::move(progress)), scans_(keys_, poses_) {}

AdjustedPath PathAdjuster::adjust() {
  if (keys_.empty()) return {};
  goForward();
  for (int round = 0; round < kAdjust.rounds; ++round) {
    relateAnew();
    solve();
    prune();
    solve();
    report(0.4 + 0.6 * (round + 1) / kAdjust.rounds);
  }
  result_.keys = poses_;
  result_.loops = static_cast<std::size_t>(
      std::count_if(result_.relations.begin(), result_.relations.end(),
                    [](const Relation& relation) { return relation.is_loop; }));
  return result_;
}

void PathAdjuster::goForward() {
  poses_.reserve(keys_.size());
  poses_.push_back(keys_.front().T_odom_base);
  for (std::size_t key = 1; key < keys_.size(); ++key) {
    predict(key);
    if (key % kAdjust.every == 0) closeLoops(key);
    if (unsolved_ >= kAdjust.between) solve();
    report(0.4 * static_cast<double>(key) / static_cast<double>(keys_.size()));
  }
  solve();
}

void PathAdjuster::predict(std::size_t key) {
  poses_.push_back(poses_.back() * keys_[key].step.mean);
  const auto relation = scans_.withPrevious(key);
  if (!relation) return;
  result_.relations.push_back(*relation);
  poses_.back() = poses_[relation->from] * relation->T_from_to;
}

void PathAdjuster::closeLoops(std::size_t key) {
  const double since = keys_[key].way - last_loop_;
  const Doubt doubt{std::min(0.3 + kAdjust.drift * since, kAdjust.most_drift),
                    std::min(0.12 + kAdjust.turn_drift * since, kAdjust.most_turn_drift)};
  const double radius = kAdjust.radius + doubt.position;
  for (const std::size_t other : scans_.visits(key, radius, kAdjust.most_visits)) {
    if (const auto relation = scans_.withVisit(key, other, doubt)) judge(*relation);
  }
}

void PathAdjuster::judge(const Relation& relation) {
  const Pose2 found = poses_[relation.from] * relation.T_from_to;
  const Pose2 correction = found * poses_[relation.to].inverse();
  const Pose2 off = geometry::between(poses_[relation.to], found);
  const bool surprises =
      off.translation().norm() > kAdjust.surprise || std::abs(off.theta()) > kAdjust.surprise_turn;
  if (surprises) {
    takeClaim(relation, correction);
  } else {
    accept(relation);
  }
}

void PathAdjuster::accept(const Relation& relation) {
  result_.relations.push_back(relation);
  last_loop_ = keys_[relation.to].way;
  ++unsolved_;
}

bool PathAdjuster::agree(const Claim& a, const Claim& b) const {
  const Pose2& here = poses_[b.relation.to];
  const Pose2 off = geometry::between(a.correction * here, b.correction * here);
  const double way = keys_[b.relation.to].way - keys_[a.relation.to].way;
  return off.translation().norm() < 0.25 + kAdjust.drift * way &&
         std::abs(off.theta()) < 0.05 + kAdjust.turn_drift * way;
}

void PathAdjuster::takeClaim(const Relation& relation, const Pose2& correction) {
  const Claim claim{relation, correction};
  if (!claims_.empty() && !agree(claims_.back(), claim)) claims_.clear();
  claims_.push_back(claim);
  const double way = keys_[relation.to].way - keys_[claims_.front().relation.to].way;
  if (claims_.size() < kAdjust.witnesses || way < kAdjust.witness_way) return;
  for (const Claim& held : claims_) accept(held.relation);
  claims_.clear();
  solve();
}

void PathAdjuster::solve() {
  const GraphSolution solution = solvePoseGraph(keys_, result_.relations, poses_);
  poses_ = solution.poses;
  cost_ = solution.relation_cost;
  result_.wheel_scale = solution.wheel_scale;
  result_.wheel_turn = solution.wheel_turn;
  scans_.forget();
  unsolved_ = 0;
}

void PathAdjuster::relateAnew() {
  result_.relations.clear();
  for (std::size_t key = 1; key < keys_.size(); ++key) {
    if (const auto relation = scans_.withPrevious(key)) result_.relations.push_back(*relation);
    for (const std::size_t other : scans_.visits(key, kAdjust.radius, kAdjust.most_visits)) {
      if (const auto relation = scans_.withVisit(key, other, {})) {
        result_.relations.push_back(*relation);
      }
    }
  }
}

void PathAdjuster::prune() {
  std::vector<Relation> kept;
  result_.refused = 0;
  for (std::size_t i = 0; i < result_.relations.size(); ++i) {
    const bool agrees = cost_[i] < kAdjust.most_cost;
    if (agrees) kept.push_back(result_.relations[i]);
    if (!agrees && result_.relations[i].is_loop) ++result_.refused;
  }
  result_.relations = std::move(kept);
}

std::vector<geometry::StampedPose2> posesOf(const std::vector<PathPoint>& path,
                                            const std::vector<KeyScan>& keys,
                                            const std::vector<Pose2>& key_poses) {
  std::vector<geometry::StampedPose2> poses;
  for (const PathPoint& point : path) {
    const std::size_t k = point.key;
    const Pose2 from_key = geometry::between(keys[k].T_odom_base, point.T_odom_base);
    Pose2 pose = key_poses[k] * from_key;
    if (k + 1 < keys.size()) {
      const Pose2 step = geometry::between(keys[k].T_odom_base, keys[k + 1].T_odom_base);
      const Pose2 backwards =
          key_poses[k + 1] * geometry::between(keys[k + 1].T_odom_base, point.T_odom_base);
      const double there = from_key.translation().norm() + std::abs(from_key.theta());
      const double whole = step.translation().norm() + std::abs(step.theta());
      pose = geometry::interpolate(pose, backwards, std::clamp(there / whole, 0.0, 1.0));
    }
    poses.push_back({point.stamp, pose});
  }
  return poses;
}

}  // namespace sightline::mapping
