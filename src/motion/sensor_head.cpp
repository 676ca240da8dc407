#include "sightline/motion/sensor_head.h"

#include <algorithm>
#include <cmath>

namespace sightline::motion {

namespace {

using Mode = HeadCommand::Mode;

const HeadLimits& checkedLimits(const HeadLimits& limits) {
  limits.check("");
  return limits;
}

}  // namespace

SensorHead::SensorHead(const HeadLimits& limits)
    : limits_(checkedLimits(limits)),
      command_{Mode::kPosition, limits.rounded(0.0), 0.0},
      angle_(command_.position) {}

void SensorHead::command(const HeadCommand& command) {
  if (!limits_.fault(command).empty()) return;
  command_ = command;
  command_.position = limits_.rounded(command.position);
  if (command.mode == Mode::kStop) command_ = {Mode::kPosition, restingPlace(), 0.0};
}

// The step at which it can come to rest the soonest.
double SensorHead::restingPlace() const {
  const double braking_distance = 0.5 * rate_ * std::abs(rate_) / limits_.acceleration;
  return limits_.rounded(angle_ + braking_distance);
}

// Position that the head is going to: at a commanded rate it goes on until it meets a limit.
double SensorHead::target() const {
  double target = command_.position;
  if (command_.mode == Mode::kRate) target = command_.rate < 0.0 ? limits_.lower : limits_.upper;
  return std::clamp(target, limits_.lower, limits_.upper);
}

double SensorHead::wantedRate(double duration) const {
  const double left = target() - angle_;
  // Rate that can still be braked from in the steps that are left, the last one included.
  const double lag = 0.5 * limits_.acceleration * duration;
  const double braking = std::sqrt(2.0 * limits_.acceleration * std::abs(left) + lag * lag) - lag;
  double most = limits_.max_rate;
  if (command_.rate != 0.0 || command_.mode == Mode::kRate) most = std::abs(command_.rate);
  return std::copysign(std::min({most, braking, std::abs(left) / duration}), left);
}

void SensorHead::step(double duration) {
  const double change = limits_.acceleration * duration;
  rate_ += std::clamp(wantedRate(duration) - rate_, -change, change);
  angle_ = std::clamp(angle_ + rate_ * duration, limits_.lower, limits_.upper);
  const bool arrived = command_.mode == Mode::kPosition && std::abs(target() - angle_) < 1e-9;
  if (arrived && std::abs(rate_) <= change) {
    angle_ = target();
    rate_ = 0.0;
  }
}

}  // namespace sightline::motion
