#include "sightline/tracking/rival_tracks.h"

#include <algorithm>
#include <cmath>

namespace sightline::tracking {

namespace {

using geometry::UncertainPose2;

constexpr struct {
  // A start vaguer than this is searched for [m, rad].
  double vague_position = 1.0;
  double vague_heading = 0.5;
  double less = 2.3;           // log-likelihood by which a scan says less than another: tenfold
  int search_again = 16;       // scans at most, where the robot stands
  double beyond_doubt = 0.99;  // several views that speak for a pose
  double believed = 2.0;       // log odds of a start
} kRivals;

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
  T_odom_base_ = input.T_odom_base;
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
  undoubted_ = Undoubted{hypotheses_.front().track.pose().mean, T_odom_base_};
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
  const bool is_proven = rival->way.isEnough() && belief.probability() < kHopeless;
  if (!isInPushReach(hypotheses_.front(), rival->track.pose().mean) && !is_proven) return;
  rival->is_trusted = rival->is_trusted || rival->way.isEnough();
  publish(static_cast<std::size_t>(rival - hypotheses_.begin()));
}

// A start that was given holds until it is as improbable as it was that it is wrong, or another
// pose is certain: furniture alone makes one more probable now and then.
void RivalTracks::giveUpStartIfWrong() {
  if (!is_compared_ || hypotheses_.size() < 2) return;
  const auto rival = mostProbableRival();
  const bool is_refuted = std::log(probabilityOf(hypotheses_, hypotheses_.front())) < kWrongStart;
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
