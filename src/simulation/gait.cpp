#include "sightline/simulation/gait.h"

#include <algorithm>
#include <cmath>

namespace sightline::simulation {

namespace {

double blend(double a, double b, double ratio) {
  return a + ratio * (b - a);
}

}  // namespace

void GaitConfig::visit(config::FieldVisitor& visitor) {
  const config::Range swing{0.0, 0.5};
  visitor.number("height", height, {"m", {0.1, 10.0}, "of the point that the trunk turns about"});
  visitor.number("speed", speed, {"m/s", {1e-3, 50.0}, "of a person who walks"});
  visitor.number("step_rate", step_rate, {"Hz", {0.1, 10.0}, "steps a second at that speed"});
  visitor.number("lean", lean, {"rad", {-0.5, 0.5}, "mean pitch at that speed, positive forward"});
  visitor.number("pitch", pitch, {"rad", swing, "largest swing about the lean, once a step"});
  visitor.number("roll", roll, {"rad", swing, "largest swing, once in two steps"});
  visitor.number("yaw", yaw, {"rad", swing, "largest swing, once in two steps"});
  visitor.number("sway", sway, {"m", {0.0, 0.5}, "to the side, once in two steps"});
  visitor.number("bob", bob, {"m", {0.0, 0.5}, "up and down, once a step"});
  visitor.number("variation", variation,
                 {"1", {0.0, 1.0}, "share by which the swings differ from stride to stride"});
}

Eigen::Isometry3d BodyMotion::outOfPlane(double height) const {
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.linear() = attitude.rotation();
  return Eigen::Translation3d(0.0, 0.0, height + bob) * turned *
         Eigen::Translation3d(0.0, 0.0, -height);
}

BodyMotion interpolate(const BodyMotion& a, const BodyMotion& b, double ratio) {
  return {blend(a.sway, b.sway, ratio),
          blend(a.bob, b.bob, ratio),
          blend(a.yaw, b.yaw, ratio),
          {blend(a.attitude.roll, b.attitude.roll, ratio),
           blend(a.attitude.pitch, b.attitude.pitch, ratio)}};
}

Gait::Gait(const GaitConfig& config, std::uint64_t seed)
    : config_(config), random_(randomStream(seed, 3)) {
  // Different people do not start with the same foot.
  phase_ = std::uniform_real_distribution<double>(0.0, 2.0 * geometry::kPi)(random_);
  stride_ = drawStride();
  next_stride_ = drawStride();
}

Gait::StrideRatios Gait::drawStride() {
  std::uniform_real_distribution<double> ratio(1.0 - config_.variation, 1.0);
  StrideRatios stride;
  stride.pitch = ratio(random_);
  stride.roll = ratio(random_);
  stride.yaw = ratio(random_);
  return stride;
}

void Gait::step(double speed, double duration) {
  constexpr double kSettling = 0.3;  // s, for the trunk to follow a change of speed
  const double wanted = std::clamp(speed / config_.speed, 0.0, 1.0);
  pace_ += (wanted - pace_) * std::min(1.0, duration / kSettling);
  phase_ += geometry::kPi * config_.step_rate * pace_ * duration;
  if (phase_ < 2.0 * geometry::kPi) return;
  phase_ -= 2.0 * geometry::kPi;
  stride_ = next_stride_;
  next_stride_ = drawStride();
}

BodyMotion Gait::motion() const {
  const double along = phase_ / (2.0 * geometry::kPi);
  const auto swing = [&](double amplitude, double at_start, double at_end) {
    return pace_ * amplitude * blend(at_start, at_end, along);
  };
  const double roll = swing(config_.roll, stride_.roll, next_stride_.roll);
  const double yaw = swing(config_.yaw, stride_.yaw, next_stride_.yaw);
  const double pitch = swing(config_.pitch, stride_.pitch, next_stride_.pitch);
  return {pace_ * config_.sway * std::sin(phase_),
          pace_ * config_.bob * std::cos(2.0 * phase_),
          yaw * std::cos(phase_),
          {roll * std::sin(phase_), pace_ * config_.lean + pitch * std::sin(2.0 * phase_)}};
}

}  // namespace sightline::simulation
