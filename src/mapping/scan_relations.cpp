#include "sightline/mapping/scan_relations.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace sightline::mapping {

namespace {

using dead_reckoning::MatchOutcome;
using dead_reckoning::MatchState;
using geometry::Pose2;

constexpr struct {
  std::size_t before = 8;  // key scans that a scan is compared with
  std::size_t about = 4;   // on either side of the one of another visit
  std::size_t kept = 12;   // references, of a megabyte each
  double way = 6.0;        // that the robot drove between two visits of a place, at least [m]
  std::size_t gap = 8;     // key scans elsewhere between two visits
  double turn = 1.0;       // [m/rad]: a scan of another heading is as unlike as one this far away
  // What is wrong with a match of any number of beams [m, rad]: surfaces are no lines, and scans
  // of one visit err together.
  double floor_position = 0.01;
  double floor_heading = 0.003;
  double step_position = 0.005;
  double step_heading = 0.0015;
} kRelations{};

// Information where errors of independent origin come on top, for information that is singular.
Eigen::Matrix3d weakened(const Eigen::Matrix3d& information, double position, double heading) {
  const Eigen::Vector3d floor(position * position, position * position, heading * heading);
  const Eigen::Matrix3d sum = Eigen::Matrix3d::Identity() + information * floor.asDiagonal();
  const Eigen::Matrix3d weak = sum.inverse() * information;
  return 0.5 * (weak + weak.transpose());
}

}  // namespace

std::optional<Relation> ScanRelations::withPrevious(std::size_t key) const {
  if (key == 0) return std::nullopt;
  const std::size_t first = key - std::min(key, kRelations.before);
  const std::size_t centre = key - 1;
  auto relation = match(key, centre, *reference(centre, first, centre), {0.2, 0.15});
  if (!relation) return std::nullopt;
  relation->information =
      weakened(relation->information, kRelations.step_position, kRelations.step_heading);
  return relation;
}

std::optional<Relation> ScanRelations::withVisit(std::size_t key, std::size_t other,
                                                 const Doubt& doubt) {
  const std::size_t centre = std::max(other - other % kRelations.about, kRelations.about / 2);
  auto relation = match(key, centre, referenceAbout(centre), doubt);
  if (!relation) return std::nullopt;
  relation->is_loop = true;
  relation->information =
      weakened(relation->information, kRelations.floor_position, kRelations.floor_heading);
  return relation;
}

const ScanRelations::Matcher& ScanRelations::referenceAbout(std::size_t centre) {
  for (const Reference& known : references_) {
    if (known.centre == centre) return *known.matcher;
  }
  const std::size_t first = centre - std::min(centre, kRelations.about);
  const std::size_t last = std::min(centre + kRelations.about, poses_.size() - 1);
  if (references_.size() >= kRelations.kept) references_.pop_front();
  references_.push_back({centre, reference(centre, first, last)});
  return *references_.back().matcher;
}

std::shared_ptr<const ScanRelations::Matcher> ScanRelations::reference(std::size_t centre,
                                                                       std::size_t first,
                                                                       std::size_t last) const {
  dead_reckoning::SubmapConfig config;
  config.keyframes = static_cast<int>(last - first + 1);
  config.spacing = config.turn_spacing = 0.0;
  const auto matcher = std::make_shared<Matcher>(config);
  MatchOutcome taken;
  taken.state = MatchState::kMatched;
  for (std::size_t i = first; i <= last; ++i) {
    // By dead reckoning, which is the better over such a short way: by the adjusted poses, a
    // stretch of path that was once pulled long would go on to say that it is.
    const Pose2 T_centre_key = geometry::between(keys_[centre].T_odom_base, keys_[i].T_odom_base);
    matcher->learn(keys_[i].surfaces, T_centre_key, taken);
  }
  return matcher;
}

std::optional<Relation> ScanRelations::match(std::size_t key, std::size_t centre,
                                             const Matcher& matcher, const Doubt& doubt) const {
  if (!matcher.hasReference()) return std::nullopt;
  const Pose2 expected = geometry::between(poses_[centre], poses_[key]);
  const Eigen::Vector3d sigma(doubt.position, doubt.position, doubt.heading);
  const geometry::UncertainPose2 prior{expected, sigma.cwiseAbs2().asDiagonal()};
  const MatchOutcome outcome =
      matcher.match(keys_[key].surfaces, prior, {expected, doubt.position, doubt.heading});
  if (outcome.state != MatchState::kMatched) return std::nullopt;
  return Relation{centre, key, outcome.T_odom_base, outcome.information, false};
}

double ScanRelations::unlikeness(std::size_t key, std::size_t other) const {
  const Pose2 step = geometry::between(poses_[key], poses_[other]);
  return step.translation().norm() + kRelations.turn * std::abs(step.theta());
}

std::vector<std::size_t> ScanRelations::visits(std::size_t key, double radius,
                                               std::size_t most) const {
  struct Visit {
    std::size_t best;
    std::size_t last;
    double unlikeness;
  };
  std::vector<Visit> found;
  for (std::size_t i = 0; i < key && keys_[key].way - keys_[i].way > kRelations.way; ++i) {
    if ((poses_[key].translation() - poses_[i].translation()).norm() > radius) continue;
    const double here = unlikeness(key, i);
    const bool goes_on = !found.empty() && i - found.back().last <= kRelations.gap;
    if (!goes_on) found.push_back({i, i, here});
    Visit& visit = found.back();
    visit.last = i;
    if (here < visit.unlikeness) visit = {i, i, here};
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Visit& a, const Visit& b) { return a.unlikeness < b.unlikeness; });
  std::vector<std::size_t> keys;
  for (const Visit& visit : found) {
    if (keys.size() < most) keys.push_back(visit.best);
  }
  return keys;
}

}  // namespace sightline::mapping
