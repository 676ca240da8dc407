#include "sightline/dead_reckoning/dead_reckoner.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

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

UncertainPose2 bounded(UncertainPose2 step) {
  step.covariance.diagonal().array() += kLeastSigma * kLeastSigma;
  return step;
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
  MatchOutcome match(const scan::Scan& scan, const Pose2& T_base_sensor, const UncertainPose2& step,
                     double elapsed);
  void takeMatch(const MatchOutcome& outcome, const UncertainPose2& predicted_step, double elapsed,
                 DeadReckoningUpdate& update);
  UncertainPose2 predict(const std::optional<MotionPrior>& prior, double elapsed) const;
  Eigen::Vector3d accelerationTo(const Eigen::Vector3d& twist, double elapsed) const;
  bool isPossible(const Pose2& T_odom_base, double elapsed) const;
  void learn(MatchState state);
  UncertainPose2 pose() const;

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
  // The pose is known relative to the reference, that relative to odom.
  UncertainPose2 T_odom_reference_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();  // of T_odom_base_ about the reference
  Twist twist_;
  bool moving_ = false;  // whether the twist is known
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
  double bridged_ = 0.0;  // time since the last match [s]
  Sweep sweep_;
};

std::optional<DeadReckoningUpdate> DeadReckoner::Impl::update(
    const scan::Scan& scan, const Pose2& T_base_sensor, const std::optional<MotionPrior>& prior) {
  if (stamp_ && scan.stamp <= *stamp_) return std::nullopt;
  const double elapsed = stamp_ ? 1e-9 * static_cast<double>(scan.stamp - *stamp_) : 0.0;
  const UncertainPose2 step = predict(prior, elapsed);
  sweep_ = readSweep(scan, T_base_sensor, twistOf(step, elapsed).mean);
  DeadReckoningUpdate update;
  update.stamp = scan.stamp;
  if (!stamp_ || elapsed > config_.max_gap) matcher_->clear();
  if (stamp_) {
    const MatchOutcome outcome =
        matcher_->hasReference() ? match(scan, T_base_sensor, step, elapsed) : MatchOutcome();
    takeMatch(outcome, step, elapsed, update);
  }
  stamp_ = scan.stamp;
  learn(update.state);
  update.beams = sweep_.points.size();
  update.pose = pose();
  update.twist = twist_.mean;
  update.twist_covariance = twist_.covariance;
  return update;
}

UncertainPose2 DeadReckoner::Impl::predict(const std::optional<MotionPrior>& prior,
                                           double elapsed) const {
  if (prior) return bounded({prior->T_before_now, prior->covariance});
  return bounded(predictStep(config_.carrier, twist_, elapsed));
}

MatchOutcome DeadReckoner::Impl::match(const scan::Scan& scan, const Pose2& T_base_sensor,
                                       const UncertainPose2& step, double elapsed) {
  const UncertainPose2 prior = geometry::compose({T_odom_base_, covariance_}, step);
  const SearchWindow window = windowOf(config_.carrier, prior, elapsed + bridged_);
  MatchOutcome outcome = matcher_->match(sweep_, prior, window);
  const double duration = scan.geometry->timeOffsets().back();
  if (duration != 0.0 && scan.sensor_motion.empty() && outcome.state != MatchState::kFailed) {
    const Eigen::Vector3d found =
        geometry::between(T_odom_base_, outcome.T_odom_base).log() / elapsed;
    const Eigen::Vector3d acceleration = accelerationTo(found, elapsed);
    // From the middle of the step to that of the sweep.
    const Eigen::Vector3d during = found + 0.5 * (elapsed + duration) * acceleration;
    if (isLonger(duration * (during - step.mean.log() / elapsed))) {
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
  return kept * acceleration_ + (1.0 - kept) * (twist - twist_.mean) / elapsed;
}

// Whether the carrier can have made a step, as far as it is known where it began.
bool DeadReckoner::Impl::isPossible(const Pose2& T_odom_base, double elapsed) const {
  const Pose2 step = geometry::between(T_odom_base_, T_odom_base);
  const Eigen::Vector3d sigma = covariance_.diagonal().cwiseSqrt();
  const double reach = config_.carrier.max_speed * elapsed + kSlackPosition;
  const double turn = config_.carrier.max_turn_rate * elapsed + kSlackHeading;
  return step.translation().norm() < reach + 3.0 * sigma.head<2>().norm() &&
         std::abs(step.theta()) < turn + 3.0 * sigma.z();
}

// The gain of a Kalman filter whose state is the pose, and what it makes of the step: its error is
// −K e + (1 − K) w − K v, with the errors e of the pose before, w of the prediction, v of the
// match.
void DeadReckoner::Impl::takeMatch(const MatchOutcome& outcome, const UncertainPose2& predicted,
                                   double elapsed, DeadReckoningUpdate& update) {
  update.state = outcome.state;
  update.inliers = outcome.inliers;
  update.searched = outcome.searched;
  const Eigen::Matrix3d first = geometry::composeJacobianFirst(T_odom_base_, predicted.mean);
  const Eigen::Matrix3d second = geometry::composeJacobianSecond(T_odom_base_);
  const Eigen::Matrix3d before = first * covariance_ * first.transpose();
  const Eigen::Matrix3d motion = second * predicted.covariance * second.transpose();
  if (outcome.state == MatchState::kFailed) {
    covariance_ = before + motion;
    update.step = predicted;
    T_odom_base_ = T_odom_base_ * predicted.mean;
    bridged_ += elapsed;
  } else {
    const Eigen::Matrix3d prior_information = (before + motion).inverse();
    const Eigen::Matrix3d after = (prior_information + outcome.information).inverse();
    const Eigen::Matrix3d gain = after * outcome.information;
    const Eigen::Matrix3d rest = after * prior_information;
    const Eigen::Matrix3d of_match = after * outcome.information * after.transpose();
    const Eigen::Matrix3d step =
        (1.0 - outcome.common) * (gain * before * gain.transpose() + of_match) +
        rest * motion * rest.transpose() + outcome.spread;
    covariance_ = after + outcome.spread;
    update.step = {geometry::between(T_odom_base_, outcome.T_odom_base),
                   second.transpose() * step * second};
    T_odom_base_ = outcome.T_odom_base;
    bridged_ = 0.0;
  }
  const Twist twist = twistOf(update.step, elapsed);
  acceleration_ = accelerationTo(twist.mean, elapsed);
  twist_ = twist;
  moving_ = true;
}

// New surfaces are as far off as the pose they were seen from: that share of its uncertainty goes
// over to the reference, and cannot be matched away any more.
void DeadReckoner::Impl::learn(MatchState state) {
  const double share = matcher_->learn(sweep_, T_odom_base_, state);
  if (share == 0.0) return;
  const Eigen::Matrix3d handed = share * covariance_;
  covariance_ -= handed;
  const Eigen::Matrix3d kept = covariance_;
  covariance_ = handed;
  T_odom_reference_ = pose();
  covariance_ = kept;
}

UncertainPose2 DeadReckoner::Impl::pose() const {
  const Eigen::Matrix3d carried = geometry::composeJacobianFirst(
      T_odom_reference_.mean, geometry::between(T_odom_reference_.mean, T_odom_base_));
  return {T_odom_base_, carried * T_odom_reference_.covariance * carried.transpose() + covariance_};
}

void DeadReckoner::Impl::reset(const Pose2& T_odom_base) {
  stamp_.reset();
  matcher_->clear();
  T_odom_base_ = T_odom_base;
  T_odom_reference_ = {T_odom_base, Eigen::Matrix3d::Zero()};
  covariance_.setZero();
  twist_ = {};
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
