#include "sightline/tracking/rival_tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "sightline/tracking/relocaliser.h"

namespace sightline::tracking {

namespace {

using geometry::Pose2;
using geometry::UncertainPose2;

constexpr struct {
  // A start vaguer than this is searched for [m, rad].
  double vague_position = 1.0;
  double vague_heading = 0.5;
  // Log odds: a pose given by hand is wrong once in a hundred times; a robot that was tracked is
  // pushed or turned more often than it is carried away.
  double wrong_start = -4.6;
  double pushed = -6.0;
  double carried = -9.2;
  double push_reach = 0.75;   // [m]
  double slip = 0.3;          // [m]
  double slip_heading = 0.2;  // [rad]
  double claim = 9.2;         // odds of 10⁴
  double dropped = -14.0;
  std::size_t most = 40;
  double same_position = 0.1;  // of two tracks that have become one [m, rad]
  double same_heading = 0.05;
  double found_position = 0.1;  // sigma of a pose that was found [m, rad]
  double found_heading = 0.03;
  int search_again = 16;   // scans at most, where the robot stands
  double as_given = 14.2;  // of chi-square with 3 degrees of freedom, 99.7 %
  double sure = 0.9;
  double hopeless = 0.1;
  double believed = 2.0;  // log odds of a start
} kRivals;

UncertainPose2 uncertain(const Pose2& pose, double position, double heading) {
  const Eigen::Array3d sigmas(position, position, heading);
  return {pose, sigmas.square().matrix().asDiagonal()};
}

bool isToBeSearched(const UncertainPose2& start) {
  const Eigen::Vector3d sigma = start.covariance.diagonal().cwiseSqrt();
  return std::max(sigma.x(), sigma.y()) > kRivals.vague_position ||
         sigma.z() > kRivals.vague_heading;
}

bool areOne(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kRivals.same_position &&
         std::abs(geometry::wrapAngle(a.theta() - b.theta())) < kRivals.same_heading;
}

double sumOfExponentials(double a, double b) {
  return std::max(a, b) + std::log1p(std::exp(-std::abs(a - b)));
}

}  // namespace

RivalTracks::RivalTracks(const TrackingContext& context, const UncertainPose2& start,
                         std::size_t room) {
  start_ = start;
  if (isToBeSearched(start)) return;
  Hypothesis given{PoseTrack(context, start, room), PoseBelief(kRivals.believed), 0.0, 0.0, {}};
  given.is_published = given.is_trusted = true;
  hypotheses_.push_back(std::move(given));
  is_started_ = is_claimed_ = true;
}

std::optional<TrackerUpdate> RivalTracks::update(const TrackingContext& context,
                                                 const TrackerInput& input) {
  const bool is_older = newest_ && input.scan.stamp < *newest_;
  if (is_older || input.scan.beams() == 0) return std::nullopt;
  newest_ = input.scan.stamp;
  move(context, input);
  ++scans_since_search_;
  if (isInDoubt()) look(context, input);
  thinOut();
  settle();
  return is_started_ ? std::optional(report(context)) : std::nullopt;
}

// Each hypothesis goes with the odometry and takes the scan.
void RivalTracks::move(const TrackingContext& context, const TrackerInput& input) {
  way_.add(input.T_odom_base);
  for (Hypothesis& hypothesis : hypotheses_) {
    const auto update = hypothesis.track.update(context, input);
    if (!update) continue;
    hypothesis.update = *update;
    hypothesis.belief.take(update->agreement, *input.scan.geometry(), update->is_outside);
  }
}

// Compares the explanations of a scan that says something new; of one from the same place less and
// less often.
void RivalTracks::look(const TrackingContext& context, const TrackerInput& input) {
  const bool is_new = keys_.isNew(input);
  if (!is_new && scans_since_search_ < search_again_) return;
  search_again_ = is_new ? 1 : std::min(2 * search_again_, kRivals.search_again);
  keys_.add(input);
  weigh(input, is_new);
  search(context, input);
}

void RivalTracks::weigh(const TrackerInput& input, bool is_new_key) {
  for (Hypothesis& hypothesis : hypotheses_) {
    const double log_likelihood =
        logLikelihood(hypothesis.update.agreement, *input.scan.geometry(), usual_hits_);
    hypothesis.log_posterior += log_likelihood - (is_new_key ? 0.0 : hypothesis.last_key);
    hypothesis.last_key = log_likelihood;
  }
}

void RivalTracks::search(const TrackingContext& context, const TrackerInput& input) {
  scans_since_search_ = 0;
  std::vector<Hypothesis> found;
  for (const PoseCandidate& candidate : relocalise(context.map, input.scan, input.T_base_sensor)) {
    const auto is_known = [&](const Hypothesis& known) {
      return areOne(known.track.pose().mean, candidate.T_map_base);
    };
    if (std::any_of(hypotheses_.begin(), hypotheses_.end(), is_known)) continue;
    const auto start =
        uncertain(candidate.T_map_base, kRivals.found_position, kRivals.found_heading);
    Hypothesis rival{PoseTrack(context, start, candidate.room), PoseBelief(0.0), 0.0, 0.0, {}};
    rival.track.setUsualHits(usual_hits_);
    const auto update = rival.track.update(context, input);
    if (!update) continue;
    rival.update = *update;
    rival.belief.take(update->agreement, *input.scan.geometry(), update->is_outside);
    rival.last_key = logLikelihood(update->agreement, *input.scan.geometry(), usual_hits_);
    rival.log_posterior = rival.last_key + logPriorOf(context, update->pose.mean);
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
  if (!is_checked_) return start_ && mahalanobis(T_map_base) < kRivals.as_given;
  const Pose2 off = geometry::between(hypotheses_.front().track.pose().mean, T_map_base);
  return off.translation().norm() < kRivals.slip && std::abs(off.theta()) < kRivals.slip_heading;
}

double RivalTracks::mahalanobis(const Pose2& T_map_base) const {
  Eigen::Vector3d off = T_map_base.coordinates() - start_->mean.coordinates();
  off[2] = geometry::wrapAngle(off[2]);
  return off.dot(start_->covariance.inverse() * off);
}

// Prior of a pose that turned up by search and the evidence of the scans before this one: the robot
// has come there as the odometry says, or from where another hypothesis has it, pushed or carried.
double RivalTracks::logPriorOf(const TrackingContext& context, const Pose2& T_map_base) const {
  double prior = -std::numeric_limits<double>::infinity();
  if (!is_started_ || !is_checked_) {
    const double given = start_ ? -0.5 * mahalanobis(T_map_base) : 0.0;
    const double least = is_started_ ? kRivals.wrong_start : kRivals.carried;
    prior =
        std::max(least, given) + keys_.logLikelihoodBefore(context.map, T_map_base, usual_hits_);
    if (is_started_) return prior;
  }
  for (const Hypothesis& other : hypotheses_) {
    const Eigen::Vector2d position = other.track.pose().mean.translation();
    const bool is_near = (position - T_map_base.translation()).norm() < kRivals.push_reach;
    const double jump = is_near ? kRivals.pushed : kRivals.carried;
    prior = std::max(prior, other.log_posterior - other.last_key + jump);
  }
  return prior;
}

// The most probable first, without those that have become one with a better one or are hopeless.
void RivalTracks::thinOut() {
  std::stable_sort(
      hypotheses_.begin(), hypotheses_.end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.log_posterior > b.log_posterior; });
  std::vector<Hypothesis> kept;
  for (Hypothesis& hypothesis : hypotheses_) {
    const double ratio = hypothesis.log_posterior - hypotheses_.front().log_posterior;
    if (kept.size() >= kRivals.most || ratio < kRivals.dropped) break;
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Hypothesis& other) {
      return areOne(other.track.pose().mean, hypothesis.track.pose().mean);
    });
    if (same == kept.end()) {
      kept.push_back(std::move(hypothesis));
    } else {
      same->is_published = same->is_published || hypothesis.is_published;
    }
  }
  hypotheses_ = std::move(kept);
}

// Whether the rest of the map has to be looked at as well.
bool RivalTracks::isInDoubt() const {
  if (!is_claimed_ || !is_checked_ || hypotheses_.size() != 1) return true;
  const PoseBelief& belief = hypotheses_.front().belief;
  return belief.isContradicted() || belief.probability() < kRivals.sure;
}

void RivalTracks::settle() {
  if (hypotheses_.empty()) return;
  if (!hypotheses_.front().is_published) {
    for (Hypothesis& hypothesis : hypotheses_) hypothesis.is_published = false;
    hypotheses_.front().is_published = true;
    if (is_claimed_ && !hypotheses_.front().is_trusted) {
      way_.restart();
      is_claimed_ = false;
    }
  }
  if (!is_claimed_) claimIfCertain();
  if (isInDoubt()) return;
  keys_.clear();
  search_again_ = 1;
  usual_hits_ = hypotheses_.front().track.usualHits();
  hypotheses_.front().log_posterior = hypotheses_.front().last_key = 0.0;
}

void RivalTracks::claimIfCertain() {
  const Hypothesis& best = hypotheses_.front();
  double rivals = best.log_posterior - 2.0 * kRivals.claim;  // what nobody has thought of
  for (std::size_t i = 1; i < hypotheses_.size(); ++i) {
    rivals = sumOfExponentials(rivals, hypotheses_[i].log_posterior);
  }
  const bool is_certain =
      best.log_posterior - rivals >= kRivals.claim && best.belief.probability() >= kRivals.sure;
  if (!is_certain || !isSound(best.update.agreement) || !way_.isEnough()) return;
  is_claimed_ = is_started_ = true;
  start_.reset();
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.is_trusted = hypothesis.is_published;
}

double RivalTracks::probabilityOf(const Hypothesis& hypothesis) const {
  double sum = hypothesis.log_posterior;
  for (const Hypothesis& other : hypotheses_) {
    if (&other != &hypothesis) sum = sumOfExponentials(sum, other.log_posterior);
  }
  return std::exp(hypothesis.log_posterior - sum);
}

TrackerState RivalTracks::stateOf(const TrackingContext& context, double quality) const {
  if (lost_scans_ >= context.config.lost_scans) return TrackerState::kLost;
  const bool is_flagged = !is_claimed_ || quality < kRivals.sure ||
                          isVague(context.config, hypotheses_.front().update.pose.covariance);
  return is_flagged ? TrackerState::kDegraded : TrackerState::kTracking;
}

TrackerUpdate RivalTracks::report(const TrackingContext& context) {
  const Hypothesis& published = hypotheses_.front();
  TrackerUpdate update = published.update;
  update.quality = published.belief.probability() * probabilityOf(published);
  lost_scans_ = update.quality < kRivals.hopeless ? lost_scans_ + 1 : 0;
  update.state = stateOf(context, update.quality);
  update.covariance_valid = update.state != TrackerState::kLost;
  update.rivals = rivals();
  if (!update.rivals.empty()) update.rivals.erase(update.rivals.begin());
  return update;
}

void RivalTracks::inflate(double position_sigma, double heading_sigma) {
  for (Hypothesis& each : hypotheses_) each.track.inflate(position_sigma, heading_sigma);
}

void RivalTracks::setRoom(std::size_t room) {
  if (!hypotheses_.empty()) hypotheses_.front().track.memory().setRoom(room);
}

void RivalTracks::restartClock() {
  for (Hypothesis& each : hypotheses_) each.track.memory().restartClock();
  keys_.clear();
  way_.forgetLast();
  newest_.reset();
}

std::optional<UncertainPose2> RivalTracks::pose() const {
  if (!is_started_ || hypotheses_.empty()) return std::nullopt;
  return hypotheses_.front().track.pose();
}

std::optional<std::size_t> RivalTracks::room() const {
  if (!is_started_ || hypotheses_.empty()) return std::nullopt;
  return hypotheses_.front().track.room();
}

std::vector<RivalPose> RivalTracks::rivals() const {
  std::vector<RivalPose> all;
  for (const Hypothesis& each : hypotheses_) {
    all.push_back({each.track.pose(), each.track.room(), probabilityOf(each)});
  }
  return all;
}

}  // namespace sightline::tracking
