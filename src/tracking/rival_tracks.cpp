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
  double push_reach = 0.75;     // [m]
  double slip = 0.3;            // [m]
  double slip_heading = 0.2;    // [rad]
  double found_position = 0.1;  // sigma of a pose that was found [m, rad]
  double found_heading = 0.03;
  double less = 2.3;           // log-likelihood by which a scan says less than another: tenfold
  int search_again = 16;       // scans at most, where the robot stands
  double as_given = 14.2;      // of chi-square with 3 degrees of freedom, 99.7 %
  double beyond_doubt = 0.99;  // several views that speak for a pose
  double believed = 2.0;       // log odds of a start
} kRivals;

UncertainPose2 uncertain(const Pose2& pose, double position, double heading) {
  const Eigen::Array3d sigmas(position, position, heading);
  return {pose, sigmas.square().matrix().asDiagonal()};
}

bool isVagueStart(const UncertainPose2& start) {
  const Eigen::Vector3d sigma = start.covariance.diagonal().cwiseSqrt();
  return std::max(sigma.x(), sigma.y()) > kRivals.vague_position ||
         sigma.z() > kRivals.vague_heading;
}

}  // namespace

RivalTracks::RivalTracks(const TrackingContext& context, const UncertainPose2& start,
                         std::size_t room) {
  start_ = start;
  if (isVagueStart(start)) return;
  Hypothesis given{PoseTrack(context, start, room), PoseBelief(kRivals.believed), {}, 0.0, 0.0, {}};
  given.is_published = given.is_trusted = true;
  hypotheses_.push_back(std::move(given));
  is_started_ = is_claimed_ = true;
}

std::optional<TrackerUpdate> RivalTracks::update(const TrackingContext& context,
                                                 const TrackerInput& input) {
  const bool is_older = newest_ && input.scan.stamp < *newest_;
  if (is_older || input.scan.beams() == 0) return std::nullopt;
  newest_ = input.scan.stamp;
  ++scans_since_search_;
  const int wait = isSureStart() ? kRivals.search_again : search_again_;
  moveAll(input);
  takeByPublished(context, input, true);
  is_compared_ = keys_.isNew(input) || scans_since_search_ >= wait || explainsLess(input);
  if (is_compared_) takeByPublished(context, input, false);
  if (isInDoubt() && is_compared_) look(context, input);
  hypotheses_ = thinnedOut(std::move(hypotheses_), is_started_);
  dismissSurprise(input);
  settle();
  return is_started_ ? std::optional(report(context)) : std::nullopt;
}

void RivalTracks::moveAll(const TrackerInput& input) {
  way_.add(input.T_odom_base);
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.way.add(input.T_odom_base);
}

// The published one takes every scan; the others those by which they are compared, as ten of them
// cost ten times as much.
void RivalTracks::takeByPublished(const TrackingContext& context, const TrackerInput& input,
                                  bool is_published) {
  for (Hypothesis& hypothesis : hypotheses_) {
    if (hypothesis.is_published != is_published) continue;
    const auto update = hypothesis.track.update(context, input);
    if (!update) continue;
    hypothesis.update = *update;
    hypothesis.belief.take(*update, *input.scan.geometry(), input.T_odom_base);
  }
}

// Whether the published pose explains a scan less well than the last one that was compared, as
// where the robot has been carried away.
bool RivalTracks::explainsLess(const TrackerInput& input) const {
  if (is_confirmed_ || hypotheses_.empty()) return false;
  const Hypothesis& published = hypotheses_.front();
  return likelihoodOf(published.update.agreement, input) < published.last_key - kRivals.less;
}

// Compares the explanations of a scan that says something new; of those from the same place less
// and less often one.
void RivalTracks::look(const TrackingContext& context, const TrackerInput& input) {
  const bool is_new = keys_.isNew(input);
  search_again_ = is_new ? 1 : std::min(2 * search_again_, kRivals.search_again);
  keys_.add(input);
  weigh(input, is_new);
  const bool is_searched = !is_confirmed_ || isToBeSearched();
  if (is_searched && tellsPlacesApart(*input.scan.geometry())) search(context, input);
}

// Logarithm of it. Until a pose is confirmed, furniture along walls is as likely as the walls; once
// it is, another one has to be thought of only where beams contradict it, and each of them counts.
double RivalTracks::likelihoodOf(ScanAgreement agreement, const TrackerInput& input) const {
  if (is_confirmed_) agreement.repeated = 0.0;
  return logLikelihood(agreement, *input.scan.geometry(), usual_hits_);
}

void RivalTracks::weigh(const TrackerInput& input, bool is_new_key) {
  for (Hypothesis& hypothesis : hypotheses_) {
    const double log_likelihood = likelihoodOf(hypothesis.update.agreement, input);
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
    Hypothesis rival{PoseTrack(context, start, candidate.room), PoseBelief(0.0), {}, 0.0, 0.0, {}};
    rival.track.setUsualHits(usual_hits_);
    const auto update = rival.track.update(context, input);
    if (!update) continue;
    rival.update = *update;
    rival.belief.take(*update, *input.scan.geometry(), input.T_odom_base);
    rival.way.add(input.T_odom_base);
    rival.last_key = likelihoodOf(update->agreement, input);
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

// Whether the rest of the map has to be looked at.
bool RivalTracks::isToBeSearched() const {
  if (!is_claimed_ || !is_checked_ || hypotheses_.empty()) return true;
  return hypotheses_.front().belief.probability() < kSure;
}

// Whether a start that was given is as good as certain: the same view again tells nothing of it.
bool RivalTracks::isSureStart() const {
  return is_started_ && !is_confirmed_ && !isToBeSearched() &&
         probabilityOf(hypotheses_, hypotheses_.front()) >= kSure;
}

bool RivalTracks::isInDoubt() const {
  return isToBeSearched() || hypotheses_.size() != 1;
}

// What spoke against a pose that had been certain was a flaw of the map, where all that is seen on
// the way from there speaks for it again.
void RivalTracks::dismissRivals() {
  const Hypothesis& published = hypotheses_.front();
  const bool is_sure =
      published.belief.probability() >= kRivals.beyond_doubt && !published.belief.isSurprised();
  if (!is_confirmed_ || !is_claimed_ || !is_sure) return;
  hypotheses_.erase(hypotheses_.begin() + 1, hypotheses_.end());
}

// Walls out of sight are no sign that the robot has been carried away, where those in sight are as
// predicted and the search of the whole map has found nothing better.
void RivalTracks::dismissSurprise(const TrackerInput& input) {
  if (scans_since_search_ != 0 || !is_claimed_ || hypotheses_.empty()) return;
  Hypothesis& published = hypotheses_.front();
  if (!published.belief.isSurprised() || probabilityOf(hypotheses_, published) < kSure) return;
  if (!isAsPredicted(published.update, *input.scan.geometry())) return;
  published.belief.dismissSurprise(published.update, *input.scan.geometry());
}

void RivalTracks::settle() {
  if (hypotheses_.empty()) return;
  if (is_confirmed_) {
    if (is_compared_) takeOverIfCertain();
    dismissRivals();
  } else if (is_started_) {
    giveUpStartIfWrong();
  } else if (!hypotheses_.front().is_published) {
    publish(0);
  }
  if (!is_claimed_ || !is_confirmed_) claimIfCertain();
  if (isInDoubt()) return;
  keys_.clear();
  search_again_ = 1;
  usual_hits_ = hypotheses_.front().track.usualHits();
  hypotheses_.front().log_posterior = hypotheses_.front().last_key = 0.0;
}

// A pose that differs by more than a slip of the wheels has to be claimed anew.
void RivalTracks::publish(std::size_t index) {
  std::rotate(hypotheses_.begin(), hypotheses_.begin() + static_cast<std::ptrdiff_t>(index),
              hypotheses_.begin() + static_cast<std::ptrdiff_t>(index) + 1);
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.is_published = false;
  hypotheses_.front().is_published = true;
  if (!is_claimed_ || hypotheses_.front().is_trusted) return;
  way_ = hypotheses_.front().way;
  is_claimed_ = false;
}

std::vector<Hypothesis>::iterator RivalTracks::mostProbableRival() {
  const auto by_posterior = [](const Hypothesis& a, const Hypothesis& b) {
    return a.log_posterior < b.log_posterior;
  };
  return std::max_element(hypotheses_.begin() + 1, hypotheses_.end(), by_posterior);
}

// A pose that was tracked through thick and thin gives way to another only where scans speak
// against it and the other is certain; one elsewhere in the map has to prove itself on the way, one
// that the robot has been pushed to has not.
void RivalTracks::takeOverIfCertain() {
  const PoseBelief& belief = hypotheses_.front().belief;
  if (!belief.isContradicted() || hypotheses_.size() < 2) return;
  const auto rival = mostProbableRival();
  if (!isCertain(hypotheses_, *rival)) return;
  const Pose2& published = hypotheses_.front().track.pose().mean;
  const double distance = (rival->track.pose().mean.translation() - published.translation()).norm();
  const bool is_proven = rival->way.isEnough() && belief.probability() < kHopeless;
  if (distance >= kRivals.push_reach && !is_proven) return;
  rival->is_trusted = rival->is_trusted || rival->way.isEnough();
  publish(static_cast<std::size_t>(rival - hypotheses_.begin()));
}

// A start that was given holds until it is as improbable as it was that it is wrong, or another
// pose is certain: furniture alone makes one more probable now and then.
void RivalTracks::giveUpStartIfWrong() {
  if (!is_compared_ || hypotheses_.size() < 2) return;
  const auto rival = mostProbableRival();
  const bool is_refuted =
      std::log(probabilityOf(hypotheses_, hypotheses_.front())) < kRivals.wrong_start;
  if (!is_refuted && !isCertain(hypotheses_, *rival)) return;
  publish(static_cast<std::size_t>(rival - hypotheses_.begin()));
}

void RivalTracks::claimIfCertain() {
  if (!isCertain(hypotheses_, hypotheses_.front()) || !way_.isEnough()) return;
  is_claimed_ = is_started_ = is_confirmed_ = true;
  start_.reset();
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.is_trusted = hypothesis.is_published;
}

}  // namespace sightline::tracking
