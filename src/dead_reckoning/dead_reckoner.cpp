#include "sightline/dead_reckoning/dead_reckoner.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sightline/dead_reckoning/match_gain.h"
#include "sightline/dead_reckoning/motion_gradient.h"
#include "sightline/dead_reckoning/unbound_axis.h"

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;
using geometry::UncertainPose2;

// Constants of dead reckoning stand in one struct a file. 74 of them were halved and doubled, one
// at a time, on three logs: bad steps of fr079 and Intel stay within .3 points but for those whose
// comment says otherwise; so do those of a scanner of 5 cm counts (aces) within 3 points.
struct ReckonerTuning {
  // Standard deviation below which no prior is believed: rounding of a log or a message [m, rad].
  double least_sigma = 1e-4;
  // A sweep is corrected anew where the motion found moves its last beam by this much [m, rad].
  double sweep_position = 0.003;
  double sweep_heading = 0.001;
  // Uncertainty of the motion within a sweep, as a ratio of what a change of velocity makes of it.
  double sweep_unsure = 0.25;
  // A match may be this much further off than the carrier can get: it has errors too [m, rad].
  double slack_position = 0.05;
  double slack_heading = 0.05;
  // Stamps of two scanners that are nearer than this are one [s].
  double no_time = 1e-6;
  // A scan of which the reference knows no more than this share looks where nobody has looked, if
  // another scanner has matched so shortly before [s].
  double little_known = 0.3;
  double held = 0.5;
  // It joins the reference where the pose is known to this [m, rad].
  double certain_position = 0.01;
  double certain_heading = 0.01;
};
constexpr ReckonerTuning kReckoner{};

bool isLonger(const Eigen::Vector3d& moved) {
  return moved.head<2>().norm() > kReckoner.sweep_position ||
         std::abs(moved[2]) > kReckoner.sweep_heading;
}

bool isFound(const Match& match) {
  return match.outcome.state != MatchState::kFailed && match.outcome.state != MatchState::kInitial;
}

}  // namespace

DeadReckoner::DeadReckoner(const DeadReckonerConfig& config)
    : config_(config), habit_(config.carrier), matcher_(makeMatcher(config)) {}

std::optional<DeadReckoningUpdate> DeadReckoner::update(
    const scan::Scan& scan, const Pose2& T_base_sensor, const std::optional<MotionPrior>& prior,
    const std::optional<scan::ElapsedTime>& elapsed, std::size_t scanner) {
  const auto found = match(scan, T_base_sensor, prior, elapsed, scanner);
  return found ? std::optional(commit(*found)) : std::nullopt;
}

std::optional<Match> DeadReckoner::match(const scan::Scan& scan, const Pose2& T_base_sensor,
                                         const std::optional<MotionPrior>& prior,
                                         const std::optional<scan::ElapsedTime>& elapsed,
                                         std::size_t scanner) const {
  Match match = begin(scan, elapsed, scanner);
  const bool is_older = match.elapsed < 0.0 || match.since_own.value_or(1.0) <= 0.0;
  if (!match.is_first && is_older) return std::nullopt;
  matchWithin(match.elapsed, habit_.expected(), scan, T_base_sensor, prior, match);
  if (isNewView(match)) {
    match.outcome = {};
    match.outcome.state = MatchState::kInitial;
  } else if (match.outcome.state == MatchState::kFailed && !match.is_first) {
    Match wider = match;
    const double longer = elapsed ? elapsed->longest - elapsed->usual : 0.0;
    matchWithin(match.elapsed + longer, config_.carrier, scan, T_base_sensor, prior, wider);
    if (wider.outcome.state != MatchState::kFailed) match = std::move(wider);
  }
  if (isFound(match)) {
    match.step = geometry::between(T_odom_base_, match.outcome.T_odom_base);
  } else {
    if (!match.is_first) match.step = match.prediction.step;
    match.motion_covariance = motionDisplacement(match.surfaces, T_odom_base_ * match.step);
  }
  match.T_odom_base = T_odom_base_ * match.step;
  return match;
}

Match DeadReckoner::begin(const scan::Scan& scan, const std::optional<scan::ElapsedTime>& elapsed,
                          std::size_t scanner) const {
  Match match;
  match.stamp = scan.stamp;
  match.scanner = scanner;
  match.revision = revision_;
  match.is_first = !stamp_;
  if (const ScannerTrack* own = tracks_.of(scanner)) {
    match.since_own =
        elapsed ? elapsed->usual : 1e-9 * static_cast<double>(scan.stamp - own->stamp);
    match.elapsed_sigma = elapsed ? elapsed->sigma : 0.0;
    match.elapsed = *match.since_own - (time_ - own->time);
  } else if (stamp_) {
    match.elapsed = 1e-9 * static_cast<double>(scan.stamp - *stamp_);
  }
  if (std::abs(match.elapsed) < kReckoner.no_time) match.elapsed = 0.0;
  return match;
}

bool DeadReckoner::isNewView(const Match& match) const {
  if (match.is_first || match.outcome.state != MatchState::kFailed) return false;
  if (match.outcome.known > kReckoner.little_known) return false;
  return tracks_.isHeldByOther(match.scanner, time_ + match.elapsed - kReckoner.held);
}

void DeadReckoner::matchWithin(double elapsed, const CarrierConfig& carrier, const scan::Scan& scan,
                               const Pose2& T_base_sensor, const std::optional<MotionPrior>& prior,
                               Match& match) const {
  if (match.since_own) *match.since_own += elapsed - match.elapsed;
  match.elapsed = elapsed;
  match.prediction = predict(carrier, prior, elapsed);
  const Eigen::Vector3d twist = elapsed > 0.0 ? match.prediction.step.log() / elapsed : twist_;
  match.surfaces = readSurfaces(scan, T_base_sensor, twist);
  match.surfaces.scanner = match.scanner;
  if (!match.is_first && matcher_->hasReference()) locate(scan, T_base_sensor, match);
}

StepPrediction DeadReckoner::predict(const CarrierConfig& carrier,
                                     const std::optional<MotionPrior>& prior,
                                     double elapsed) const {
  StepPrediction prediction = predictStep(carrier, twist_, elapsed);
  if (prior) prediction = {prior->T_before_now, prior->covariance, Eigen::Matrix3d::Zero()};
  prediction.covariance.diagonal().array() += kReckoner.least_sigma * kReckoner.least_sigma;
  return prediction;
}

void DeadReckoner::locate(const scan::Scan& scan, const Pose2& T_base_sensor, Match& match) const {
  const UncertainPose2 predicted{T_odom_base_ * match.prediction.step,
                                 errors_.predicted(T_odom_base_, match.prediction)};
  const SearchWindow window =
      windowOf(config_.carrier, predicted, std::min(match.elapsed + bridged_, config_.max_gap));
  match.outcome = matcher_->match(match.surfaces, predicted, window);
  if (scan.duration() != 0.0 && scan.sensorMotion().empty() &&
      match.outcome.state != MatchState::kFailed) {
    correctSweep(scan, T_base_sensor, predicted, window, match);
  }
  if (!isPossible(match.outcome.T_odom_base, match.elapsed)) {
    match.outcome.state = MatchState::kFailed;
  }
  match.motion_covariance = motionCovariance(predicted, match.outcome);
  if (!match.prediction.by_twist.isZero(0.0)) {
    match.measured = measuredShares(predicted, match.outcome);
  }
}

void DeadReckoner::correctSweep(const scan::Scan& scan, const Pose2& T_base_sensor,
                                const UncertainPose2& predicted, const SearchWindow& window,
                                Match& match) const {
  const double duration = scan.duration();
  const ScannerTrack* own = tracks_.of(match.scanner);
  if (own == nullptr) return;
  const double elapsed = *match.since_own;
  const Eigen::Vector3d found = own->stepTo(match.outcome.T_odom_base).log() / elapsed;
  const Eigen::Vector3d acceleration = own->accelerationTo(found, elapsed);
  // Velocity in the middle of the sweep; the one found holds in the middle of the step.
  const Eigen::Vector3d during = found + 0.5 * (elapsed + duration) * acceleration;
  const Eigen::Vector3d assumed =
      match.elapsed > 0.0 ? match.prediction.step.log() / match.elapsed : twist_;
  if (isLonger(duration * (during - assumed))) {
    match.surfaces = readSurfaces(scan, T_base_sensor, during);
    match.surfaces.scanner = match.scanner;
    match.outcome = matcher_->match(match.surfaces, predicted, window);
  }
  const Eigen::Vector3d unsure = kReckoner.sweep_unsure * duration * elapsed * acceleration;
  match.outcome.extra_covariance += unsure.cwiseAbs2().asDiagonal();
}

// Tells whether the carrier can have made a step, as far as it is known where it began.
bool DeadReckoner::isPossible(const Pose2& T_odom_base, double elapsed) const {
  const Pose2 step = geometry::between(T_odom_base_, T_odom_base);
  const Eigen::Vector3d sigma = errors_.againstReference().diagonal().cwiseSqrt();
  const double reach = config_.carrier.max_speed * elapsed + kReckoner.slack_position;
  const double rotation = config_.carrier.max_turn_rate * elapsed + kReckoner.slack_heading;
  return step.translation().norm() < reach + 3.0 * sigma.head<2>().norm() &&
         std::abs(step.theta()) < rotation + 3.0 * sigma.z();
}

DeadReckoningUpdate DeadReckoner::commit(const Match& match) {
  if (match.revision != revision_) {
    throw std::invalid_argument("a match that was made before the last change of the reckoner");
  }
  ++revision_;
  DeadReckoningUpdate update;
  update.stamp = match.stamp;
  update.beams = match.surfaces.points.size();
  update.inliers = match.outcome.inliers;
  if (!match.is_first) {
    update.state = match.outcome.state;
    update.step = advance(match);
    const bool is_loose = isLoose(update.step.covariance);
    if (is_loose && update.state == MatchState::kMatched) update.state = MatchState::kUnbound;
  }
  stamp_ = match.stamp;
  time_ += match.elapsed;
  follow(match);
  learn(match);
  update.pose = {T_odom_base_, errors_.pose()};
  update.twist = {twist_, errors_.twist()};
  if (match.since_own) {
    const double ratio = match.elapsed_sigma / *match.since_own;
    update.twist.covariance += ratio * ratio * twist_ * twist_.transpose();
  }
  return update;
}

UncertainPose2 DeadReckoner::advance(const Match& match) {
  PoseMeasurement measurement;
  bridged_ += match.elapsed;
  if (isFound(match)) {
    measurement = {match.outcome.information, match.outcome.extra_covariance,
                   match.motion_covariance, match.outcome.common};
    bridged_ = 0.0;
  }
  const ScannerTrack* own = tracks_.of(match.scanner);
  const TwistInterval interval =
      own == nullptr || match.outcome.state == MatchState::kInitial
          ? TwistInterval{match.scanner, {}, {}, 0.0}
          : TwistInterval{match.scanner, own->T_odom_base, own->stepTo(match.T_odom_base),
                          *match.since_own};
  const Eigen::Matrix3d covariance =
      errors_.advance(T_odom_base_, match.prediction, interval, measurement);
  T_odom_base_ = match.T_odom_base;
  return {match.step, covariance};
}

// Goes on with the velocity since the same scanner's scan before.
void DeadReckoner::follow(const Match& match) {
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  const ScannerTrack* own = tracks_.of(match.scanner);
  if (own != nullptr && match.outcome.state != MatchState::kInitial) {
    const Eigen::Vector3d twist = own->stepTo(T_odom_base_).log() / *match.since_own;
    const bool is_motion = match.outcome.state == MatchState::kMatched;  // and no jump back
    if (is_motion) habit_.learn(own->twist, twist, *match.since_own, match.measured);
    acceleration = own->accelerationTo(twist, *match.since_own);
    twist_ = twist;
    moving_ = true;
  }
  const bool is_held = isFound(match) || match.is_first;
  tracks_.set(match.scanner,
              {match.stamp, time_, T_odom_base_, moving_, twist_, acceleration, is_held});
}

// Whether the place of a new view is known so well that it may be put into the reference: where it
// is off, it stays off against what the other scanners see.
bool DeadReckoner::isCertain(const Match& match) const {
  if (!moving_ && match.elapsed > 0.0) return false;
  const Eigen::Vector3d sigma = errors_.againstReference().diagonal().cwiseSqrt();
  return sigma.head<2>().maxCoeff() < kReckoner.certain_position &&
         sigma.z() < kReckoner.certain_heading;
}

void DeadReckoner::learn(const Match& match) {
  if (match.is_first) matcher_->clear();
  const bool had_reference = matcher_->hasReference();
  const bool is_vague =
      match.outcome.state == MatchState::kInitial && !match.is_first && !isCertain(match);
  const double share_new =
      is_vague ? 0.0 : matcher_->learn(match.surfaces, T_odom_base_, match.outcome);
  // The pose is certain against a reference that begins with it, however long the gap was.
  const bool begins = !had_reference && matcher_->hasReference();
  if (begins) bridged_ = 0.0;
  if (!isFound(match)) errors_.displace(match.motion_covariance);
  errors_.handOver(begins ? 1.0 : share_new);
}

void DeadReckoner::reset(const Pose2& T_odom_base) {
  ++revision_;
  stamp_.reset();
  matcher_->clear();
  T_odom_base_ = T_odom_base;
  errors_.reset();
  habit_.reset();
  twist_.setZero();
  moving_ = false;
  tracks_.clear();
  time_ = 0.0;
  bridged_ = 0.0;
}

void DeadReckoner::restartClock() {
  ++revision_;
  stamp_.reset();
  tracks_.clear();
  errors_.forgetScans();
}

}  // namespace sightline::dead_reckoning
