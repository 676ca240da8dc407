#include "sightline/driver/head_watch.h"

#include <cmath>

#include <fmt/format.h>

namespace sightline::driver {

namespace {

constexpr double kArrived = 0.02;                   // [rad]: three steps of the servo
constexpr double kStill = 2e-3;                     // [rad], less than a step
constexpr std::int64_t kStandsFor = 1'000'000'000;  // [ns]

}  // namespace

// Commands that come again and again give a stuck head no more time.
void HeadWatch::command(const motion::HeadCommand& command, std::int64_t now) {
  if (!shallMove()) moved_ = now;
  command_ = command;
}

// A head that turns at a rate halts at its limits.
bool HeadWatch::shallMove() const {
  using Mode = motion::HeadCommand::Mode;
  if (!command_ || command_->mode == Mode::kStop) return false;
  if (command_->mode == Mode::kPosition) return std::abs(angle_ - command_->position) > kArrived;
  const double limit = command_->rate > 0.0 ? limits_.upper : limits_.lower;
  const bool is_slow = std::abs(command_->rate) * 1e-9 * kStandsFor < 2.0 * kArrived;
  return !is_slow && std::abs(angle_ - limit) > kArrived;
}

std::string HeadWatch::describe() const {
  using Mode = motion::HeadCommand::Mode;
  const std::string told = command_->mode == Mode::kPosition
                               ? fmt::format("sent to {:.2f} rad", command_->position)
                               : fmt::format("told to turn at {:.2f} rad/s", command_->rate);
  return fmt::format("does not follow: at {:.2f} rad, {}", angle_, told);
}

void HeadWatch::observe(const std::vector<double>& head_angles, std::int64_t now) {
  if (head_angles.empty()) return;
  const double angle = head_angles.back();
  if (std::abs(angle - angle_) > kStill) {
    angle_ = angle;
    moved_ = now;
  }
  const bool is_stuck = shallMove() && now - moved_ > kStandsFor;
  fault_ = is_stuck ? describe() : "";
}

}  // namespace sightline::driver
