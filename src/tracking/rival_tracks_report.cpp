#include "sightline/tracking/rival_tracks.h"

namespace sightline::tracking {

TrackerState RivalTracks::stateOf(const TrackingContext& context, double quality) const {
  const TrackerUpdate& update = hypotheses_.front().update;
  if (update.state == TrackerState::kLost) return TrackerState::kLost;
  const bool is_flagged =
      !is_claimed_ || quality < kSure || isVague(context.config, update.pose.covariance);
  return is_flagged ? TrackerState::kDegraded : TrackerState::kTracking;
}

TrackerUpdate RivalTracks::report(const TrackingContext& context) {
  const Hypothesis& published = hypotheses_.front();
  TrackerUpdate update = published.update;
  update.quality = published.belief.probability() * probabilityOf(hypotheses_, published);
  update.state = stateOf(context, update.quality);
  update.covariance_valid = update.state != TrackerState::kLost && update.quality >= kHopeless;
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
  undoubted_.reset();
  newest_.reset();
}

std::optional<geometry::UncertainPose2> RivalTracks::pose() const {
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
    all.push_back({each.track.pose(), each.track.room(), probabilityOf(hypotheses_, each)});
  }
  return all;
}

}  // namespace sightline::tracking
