#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "sightline/tracking/relocaliser.h"
#include "sightline/tracking/rival_tracks.h"

namespace sightline::tracking {

namespace {

using geometry::Pose2;
using geometry::UncertainPose2;

constexpr struct {
  // Log odds: a robot that was tracked is pushed or turned more often than it is carried away.
  double pushed = -6.0;
  double carried = -9.2;
  double push_reach = 0.75;     // [m]
  double slip = 0.3;            // [m]
  double slip_heading = 0.2;    // [rad]
  double found_position = 0.1;  // sigma of a pose that was found [m, rad]
  double found_heading = 0.03;
  double better = 2.3;     // log-likelihood of a scan by the other of two: tenfold
  double as_given = 14.2;  // of chi-square with 3 degrees of freedom, 99.7 %
} kRivalSearch;

UncertainPose2 uncertain(const Pose2& pose, double position, double heading) {
  const Eigen::Array3d sigmas(position, position, heading);
  return {pose, sigmas.square().matrix().asDiagonal()};
}

}  // namespace

void RivalTracks::search(const TrackingContext& context, const TrackerInput& input) {
  scans_since_search_ = 0;
  std::vector<Hypothesis> found;
  for (const PoseCandidate& candidate : relocalise(context.map, input.scan, input.T_base_sensor)) {
    const auto is_known = [&](const Hypothesis& known) {
      return areOne(known.track.pose().mean, candidate.T_map_base);
    };
    if (std::any_of(hypotheses_.begin(), hypotheses_.end(), is_known)) continue;
    const auto start =
        uncertain(candidate.T_map_base, kRivalSearch.found_position, kRivalSearch.found_heading);
    Hypothesis rival{PoseTrack(context, start, candidate.room), PoseBelief(0.0), {}, 0.0, 0.0, {}};
    rival.track.setUsualHits(usual_hits_);
    const auto update = rival.track.update(context, input);
    if (!update) continue;
    rival.update = *update;
    rival.belief.take(*update, *input.scan.geometry(), input.T_odom_base);
    rival.way.add(input.T_odom_base);
    rival.last_key = likelihoodOf(update->agreement, input);
    rival.log_posterior = rival.last_key + logPriorOf(context, rival);
    rival.is_trusted = isTrusted(update->pose.mean);
    found.push_back(std::move(rival));
  }
  for (Hypothesis& rival : found) hypotheses_.push_back(std::move(rival));
  is_checked_ = true;
}

// Whether a pose that was found is the given one, as far as that was said to be known, or differs
// from the published one by no more than a slip of the wheels.
bool RivalTracks::isTrusted(const Pose2& T_map_base) const {
  if (!is_claimed_ || hypotheses_.empty()) return false;
  if (!is_checked_) return start_ && mahalanobis(T_map_base) < kRivalSearch.as_given;
  const Pose2 off = geometry::between(hypotheses_.front().track.pose().mean, T_map_base);
  return off.translation().norm() < kRivalSearch.slip &&
         std::abs(off.theta()) < kRivalSearch.slip_heading;
}

double RivalTracks::mahalanobis(const Pose2& T_map_base) const {
  Eigen::Vector3d off = T_map_base.coordinates() - start_->mean.coordinates();
  off[2] = geometry::wrapAngle(off[2]);
  return off.dot(start_->covariance.inverse() * off);
}

// Whether the robot may have been pushed or turned from where a hypothesis has it to a pose: now,
// or when nothing was in doubt last. A pose that goes on at a wrong heading runs away from the
// right one.
bool RivalTracks::isInPushReach(const Hypothesis& from, const Pose2& T_map_base) const {
  const Pose2& T_map_other = from.track.pose().mean;
  const auto reaches = [](const Pose2& a, const Pose2& b) {
    return (a.translation() - b.translation()).norm() < kRivalSearch.push_reach;
  };
  if (reaches(T_map_other, T_map_base)) return true;
  if (!undoubted_ || !from.is_published) return false;
  const Pose2 back = geometry::between(T_odom_base_, undoubted_->T_odom_base);
  return reaches(undoubted_->T_map_base, T_map_base * back);
}

// Prior of a pose that turned up by search and the evidence of the scans before this one: the robot
// has come there as the odometry says, or from where another hypothesis has it, pushed or carried.
// It has not from one that explains the scan as well: along a corridor there is always a next
// place.
double RivalTracks::logPriorOf(const TrackingContext& context, const Hypothesis& rival) const {
  const Pose2& T_map_base = rival.track.pose().mean;
  double prior = -std::numeric_limits<double>::infinity();
  if (!is_started_ || !is_checked_) {
    const double given = start_ ? -0.5 * mahalanobis(T_map_base) : 0.0;
    const double least = is_started_ ? kWrongStart : kRivalSearch.carried;
    prior =
        std::max(least, given) + keys_.logLikelihoodBefore(context.map, T_map_base, usual_hits_);
    if (is_started_) return prior;
  }
  for (const Hypothesis& other : hypotheses_) {
    if (rival.last_key - other.last_key < kRivalSearch.better) continue;
    const double jump =
        isInPushReach(other, T_map_base) ? kRivalSearch.pushed : kRivalSearch.carried;
    prior = std::max(prior, other.log_posterior - other.last_key + jump);
  }
  return prior;
}

}  // namespace sightline::tracking
