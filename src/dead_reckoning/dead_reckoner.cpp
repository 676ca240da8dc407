#include "sightline/dead_reckoning/dead_reckoner.h"

#include <algorithm>
#include <cmath>

#include "sightline/dead_reckoning/error_state.h"
#include "sightline/dead_reckoning/histogram_matcher.h"
#include "sightline/dead_reckoning/matcher.h"
#include "sightline/dead_reckoning/motion_model.h"
#include "sightline/dead_reckoning/pose_space.h"
#include "sightline/dead_reckoning/submap_matcher.h"
#include "sightline/dead_reckoning/surface_points.h"

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;
using geometry::UncertainPose2;

// The prior is never taken for more certain than this: rounding of a log or a message [m, rad].
constexpr double kLeastSigma = 1e-4;
// A window is no wider than what the carrier can do in this time, however long was bridged [s].
constexpr double kLongestSearch = 10.0;
// A sweep is corrected anew where the motion found moves its last beam by this much [m, rad].
constexpr double kSweepPosition = 0.003;
constexpr double kSweepHeading = 0.001;
// How well the motion within a sweep is known, as a share of what a change of velocity makes of it.
constexpr double kAccelerationTime = 0.15;  // [s]
// A match may be this much further off than the carrier can get: it has errors too.
constexpr double kSlackPosition = 0.05;  // [m]
constexpr double kSlackHeading = 0.05;   // [rad]
constexpr double kSweepUnsure = 0.25;

std::unique_ptr<Matcher> makeMatcher(const DeadReckonerConfig& config) {
  config::validate(config);
  switch (config.method) {
    case Method::kPoseSpace:
      return std::make_unique<PoseSpaceMatcher>(config.pose_space);
    case Method::kHistogram:
      return std::make_unique<HistogramMatcher>(config.histogram);
    case Method::kSubmap:
      break;
  }
  return std::make_unique<SubmapMatcher>(config.submap);
}

bool isLonger(const Eigen::Vector3d& moved) {
  return moved.head<2>().norm() > kSweepPosition || std::abs(moved[2]) > kSweepHeading;
}

}  // namespace

class DeadReckoner::Impl {
 public:
  explicit Impl(const DeadReckonerConfig& config)
      : config_(config), matcher_(makeMatcher(config)) {}

  std::optional<DeadReckoningUpdate> update(const scan::Scan& scan, const Pose2& T_base_sensor,
                                            const std::optional<MotionPrior>& prior);
  void reset(const Pose2& T_odom_base);
  void restartClock() { stamp_.reset(); }

 private:
  MatchOutcome match(const scan::Scan& scan, const Pose2& T_base_sensor, const StepPrediction& step,
                     double elapsed);
  void takeMatch(const MatchOutcome& outcome, const StepPrediction& prediction, double elapsed,
                 DeadReckoningUpdate& update);
  StepPrediction predict(const std::optional<MotionPrior>& prior, double elapsed) const;
  Eigen::Vector3d accelerationTo(const Eigen::Vector3d& twist, double elapsed) const;
  bool isPossible(const Pose2& T_odom_base, double elapsed) const;

  /// A matcher that is copied with whoever has it.
  class OwnMatcher {
   public:
    explicit OwnMatcher(std::unique_ptr<Matcher> matcher) : matcher_(std::move(matcher)) {}
    OwnMatcher(const OwnMatcher& other) : matcher_(other.matcher_->clone()) {}
    Matcher* operator->() const { return matcher_.get(); }

   private:
    std::unique_ptr<Matcher> matcher_;
  };

  DeadReckonerConfig config_;
  OwnMatcher matcher_;
  std::optional<std::int64_t> stamp_;
  Pose2 T_odom_base_;
  ErrorState errors_;
  Eigen::Vector3d twist_ = Eigen::Vector3d::Zero();
  bool moving_ = false;  // whether the twist is known
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
  double bridged_ = 0.0;  // time since the last match [s]
  Sweep sweep_;
};

std::optional<DeadReckoningUpdate> DeadReckoner::Impl::update(
    const scan::Scan& scan, const Pose2& T_base_sensor, const std::optional<MotionPrior>& prior) {
  if (stamp_ && scan.stamp <= *stamp_) return std::nullopt;
  const double elapsed = stamp_ ? 1e-9 * static_cast<double>(scan.stamp - *stamp_) : 0.0;
  const StepPrediction step = predict(prior, elapsed);
  const Eigen::Vector3d twist = elapsed > 0.0 ? step.step.log() / elapsed : twist_;
  sweep_ = readSweep(scan, T_base_sensor, twist);
  DeadReckoningUpdate update;
  update.stamp = scan.stamp;
  if (!stamp_ || elapsed > config_.max_gap) matcher_->clear();
  const bool had_reference = matcher_->hasReference();
  if (stamp_) {
    const MatchOutcome outcome =
        matcher_->hasReference() ? match(scan, T_base_sensor, step, elapsed) : MatchOutcome();
    takeMatch(outcome, step, elapsed, update);
  }
  stamp_ = scan.stamp;
  const double share_new = matcher_->learn(sweep_, T_odom_base_, update.state);
  // Against a reference that begins with it the pose is certain, however long the gap was.
  const bool begins = !had_reference && matcher_->hasReference();
  if (begins) bridged_ = 0.0;
  errors_.handOver(begins ? 1.0 : share_new);
  update.beams = sweep_.points.size();
  update.pose = {T_odom_base_, errors_.pose()};
  update.twist = twist_;
  update.twist_covariance = errors_.twist();
  return update;
}

StepPrediction DeadReckoner::Impl::predict(const std::optional<MotionPrior>& prior,
                                           double elapsed) const {
  StepPrediction prediction = predictStep(config_.carrier, twist_, elapsed);
  if (prior) prediction = {prior->T_before_now, prior->covariance, Eigen::Matrix3d::Zero()};
  prediction.covariance.diagonal().array() += kLeastSigma * kLeastSigma;
  return prediction;
}

MatchOutcome DeadReckoner::Impl::match(const scan::Scan& scan, const Pose2& T_base_sensor,
                                       const StepPrediction& step, double elapsed) {
  const UncertainPose2 prior{T_odom_base_ * step.step, errors_.predicted(T_odom_base_, step)};
  const SearchWindow window =
      windowOf(config_.carrier, prior, std::min(elapsed + bridged_, kLongestSearch));
  MatchOutcome outcome = matcher_->match(sweep_, prior, window);
  const double duration = scan.geometry()->timeOffsets().back();
  if (duration != 0.0 && scan.sensorMotion().empty() && outcome.state != MatchState::kFailed) {
    const Eigen::Vector3d found =
        geometry::between(T_odom_base_, outcome.T_odom_base).log() / elapsed;
    const Eigen::Vector3d acceleration = accelerationTo(found, elapsed);
    // From the middle of the step to that of the sweep.
    const Eigen::Vector3d during = found + 0.5 * (elapsed + duration) * acceleration;
    if (isLonger(duration * (during - step.step.log() / elapsed))) {
      sweep_ = readSweep(scan, T_base_sensor, during);
      outcome = matcher_->match(sweep_, prior, window);
    }
    const Eigen::Vector3d unsure = kSweepUnsure * duration * elapsed * acceleration;
    outcome.spread += unsure.cwiseAbs2().asDiagonal();
  }
  if (!isPossible(outcome.T_odom_base, elapsed)) outcome.state = MatchState::kFailed;
  return outcome;
}

// Averaged over some time, as what is found of a sweep comes back in what is found of the next.
Eigen::Vector3d DeadReckoner::Impl::accelerationTo(const Eigen::Vector3d& twist,
                                                   double elapsed) const {
  if (!moving_) return Eigen::Vector3d::Zero();
  const double kept = std::exp(-elapsed / kAccelerationTime);
  return kept * acceleration_ + (1.0 - kept) * (twist - twist_) / elapsed;
}

// Whether the carrier can have made a step, as far as it is known where it began.
bool DeadReckoner::Impl::isPossible(const Pose2& T_odom_base, double elapsed) const {
  const Pose2 step = geometry::between(T_odom_base_, T_odom_base);
  const Eigen::Vector3d sigma = errors_.againstReference().diagonal().cwiseSqrt();
  const double reach = config_.carrier.max_speed * elapsed + kSlackPosition;
  const double turn = config_.carrier.max_turn_rate * elapsed + kSlackHeading;
  return step.translation().norm() < reach + 3.0 * sigma.head<2>().norm() &&
         std::abs(step.theta()) < turn + 3.0 * sigma.z();
}

void DeadReckoner::Impl::takeMatch(const MatchOutcome& outcome, const StepPrediction& prediction,
                                   double elapsed, DeadReckoningUpdate& update) {
  update.state = outcome.state;
  update.inliers = outcome.inliers;
  update.searched = outcome.searched;
  PoseMeasurement measurement;
  update.step.mean = prediction.step;
  bridged_ += elapsed;
  if (outcome.state != MatchState::kFailed) {
    measurement = {outcome.information, outcome.spread, outcome.common};
    update.step.mean = geometry::between(T_odom_base_, outcome.T_odom_base);
    bridged_ = 0.0;
  }
  update.step.covariance =
      errors_.advance(T_odom_base_, prediction, update.step.mean, elapsed, measurement);
  T_odom_base_ = T_odom_base_ * update.step.mean;
  const Eigen::Vector3d twist = update.step.mean.log() / elapsed;
  acceleration_ = accelerationTo(twist, elapsed);
  twist_ = twist;
  moving_ = true;
}

void DeadReckoner::Impl::reset(const Pose2& T_odom_base) {
  stamp_.reset();
  matcher_->clear();
  T_odom_base_ = T_odom_base;
  errors_.reset();
  twist_.setZero();
  moving_ = false;
  acceleration_.setZero();
  bridged_ = 0.0;
}

DeadReckoner::DeadReckoner(const DeadReckonerConfig& config)
    : impl_(std::make_unique<Impl>(config)) {}
DeadReckoner::~DeadReckoner() = default;
DeadReckoner::DeadReckoner(const DeadReckoner& other)
    : impl_(std::make_unique<Impl>(*other.impl_)) {}
DeadReckoner::DeadReckoner(DeadReckoner&&) noexcept = default;
DeadReckoner& DeadReckoner::operator=(DeadReckoner&&) noexcept = default;

std::optional<DeadReckoningUpdate> DeadReckoner::update(const scan::Scan& scan,
                                                        const Pose2& T_base_sensor,
                                                        const std::optional<MotionPrior>& prior) {
  return impl_->update(scan, T_base_sensor, prior);
}
void DeadReckoner::reset(const Pose2& T_odom_base) {
  impl_->reset(T_odom_base);
}
void DeadReckoner::restartClock() {
  impl_->restartClock();
}

}  // namespace sightline::dead_reckoning
