#include "sightline/dead_reckoning/dead_reckoner.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "sightline/dead_reckoning/line_matcher.h"
#include "sightline/dead_reckoning/submap.h"
#include "sightline/dead_reckoning/surface_points.h"

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;
using geometry::UncertainPose2;

}  // namespace

class DeadReckoner::Impl {
 public:
  explicit Impl(const DeadReckonerConfig& config) : config_(config) { config::validate(config); }

  std::optional<DeadReckoningUpdate> update(const scan::Scan& scan, const Pose2& T_base_sensor,
                                            const std::optional<MotionPrior>& prior);
  void reset(const Pose2& T_odom_base);
  void restartClock() { stamp_.reset(); }

 private:
  UncertainPose2 predictStep(const std::optional<MotionPrior>& prior, double elapsed) const;
  void takeStep(const UncertainPose2& step, double elapsed);
  bool isKeyframe() const;

  DeadReckonerConfig config_;
  std::optional<std::int64_t> stamp_;
  UncertainPose2 pose_;
  Eigen::Vector3d twist_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d twist_covariance_ = Eigen::Matrix3d::Zero();
  Submap submap_;
  Pose2 keyframe_;
  std::vector<SurfacePoint> points_;
};

UncertainPose2 DeadReckoner::Impl::predictStep(const std::optional<MotionPrior>& prior,
                                               double elapsed) const {
  if (prior) return {prior->T_before_now, prior->covariance};
  const CarrierConfig& carrier = config_.carrier;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const double position = carrier.acceleration * elapsed * elapsed;
  const double heading = carrier.turn_acceleration * elapsed * elapsed;
  covariance.diagonal() << position * position, position * position, heading * heading;
  return {Pose2::exp(elapsed * twist_), covariance + elapsed * elapsed * twist_covariance_};
}

void DeadReckoner::Impl::takeStep(const UncertainPose2& step, double elapsed) {
  pose_ = geometry::compose(pose_, step);
  twist_ = step.mean.log() / elapsed;
  twist_covariance_ = step.covariance / (elapsed * elapsed);
}

bool DeadReckoner::Impl::isKeyframe() const {
  const Pose2 way = geometry::between(keyframe_, pose_.mean);
  return submap_.empty() || way.translation().norm() > config_.submap.spacing ||
         std::abs(way.theta()) > config_.submap.turn_spacing;
}

std::optional<DeadReckoningUpdate> DeadReckoner::Impl::update(
    const scan::Scan& scan, const Pose2& T_base_sensor, const std::optional<MotionPrior>& prior) {
  if (stamp_ && scan.stamp <= *stamp_) return std::nullopt;
  const double elapsed = stamp_ ? 1e-9 * static_cast<double>(scan.stamp - *stamp_) : 0.0;
  stamp_ = scan.stamp;
  positionsOf(scan, T_base_sensor, twist_, points_);
  findSurfaces(T_base_sensor.translation(), std::abs(scan.geometry->angleIncrement()), points_);
  DeadReckoningUpdate update;
  update.stamp = scan.stamp;
  update.beams = points_.size();
  if (!submap_.empty() && elapsed > 0.0) {
    UncertainPose2 step = predictStep(prior, elapsed);
    const Pose2 predicted = pose_.mean * step.mean;
    const Eigen::Matrix3d turn = geometry::composeJacobianSecond(pose_.mean);
    const PosePrior belief{predicted, (turn * step.covariance * turn.transpose()).inverse()};
    const LineMatch match =
        matchLines(points_, submap_, predicted, belief, config_.submap.surface_sigma, 0.2);
    update.inliers = match.inliers;
    update.state =
        match.inliers > config_.submap.min_inliers ? MatchState::kMatched : MatchState::kFailed;
    const Eigen::Matrix3d covariance = (match.information + belief.information).inverse();
    step = {geometry::between(pose_.mean, match.T_odom_base), turn.transpose() * covariance * turn};
    takeStep(step, elapsed);
    update.step = step;
  }
  if (isKeyframe()) {
    submap_.add(pose_.mean, points_, static_cast<std::size_t>(config_.submap.keyframes));
    keyframe_ = pose_.mean;
  }
  update.pose = pose_;
  update.twist = twist_;
  update.twist_covariance = twist_covariance_;
  return update;
}

void DeadReckoner::Impl::reset(const Pose2& T_odom_base) {
  stamp_.reset();
  pose_ = {T_odom_base, Eigen::Matrix3d::Zero()};
  twist_.setZero();
  twist_covariance_.setZero();
  submap_.clear();
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
