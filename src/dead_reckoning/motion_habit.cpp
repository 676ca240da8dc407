#include "sightline/dead_reckoning/motion_habit.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

constexpr struct {
  // Change of velocity, and turn rate, before anything is known, over what the carrier is capable
  // of: it stands at first, but may turn on the spot.
  double first_change = 0.25;
  double first_turn_rate = 0.25;
  // Least of the change of velocity and of the speed: of translation [m/s², m/s] and of heading
  // [rad/s², rad/s].
  double least_change[2] = {0.1, 0.25};
  double least_speed[2] = {0.6, 0.75};
  // Scans over which what was learned fades.
  double change_fades = 20.0;
  double speed_fades = 100.0;
  // Ratio of what is expected to the rms of what was seen.
  double change_factor = 0.8;
  double speed_factor = 1.2;
} kHabit;

Eigen::Vector2d sizeOf(const Eigen::Vector3d& twist) {
  return {twist.head<2>().norm(), std::abs(twist.z())};
}

// What was not measured is learned neither as calm nor as surprise.
void follow(double value, double measured, double scans, double& rms) {
  const double faded = rms * rms + measured * (value * value - rms * rms) / scans;
  rms = std::max(measured * value, std::sqrt(faded));
}

}  // namespace

void MotionHabit::reset() {
  change_ = kHabit.first_change * Eigen::Vector2d(limits_.acceleration, limits_.turn_acceleration);
  speed_ = {0.0, kHabit.first_turn_rate * limits_.max_turn_rate};
}

void MotionHabit::learn(const Eigen::Vector3d& expected, const Eigen::Vector3d& twist,
                        double elapsed, const Eigen::Vector2d& measured) {
  const Eigen::Vector2d change = sizeOf(twist - expected) / elapsed;
  const Eigen::Vector2d speed = sizeOf(twist);
  for (int i = 0; i < 2; ++i) {
    follow(change[i], measured[i], kHabit.change_fades, change_[i]);
    follow(speed[i], measured[i], kHabit.speed_fades, speed_[i]);
  }
}

CarrierConfig MotionHabit::expected() const {
  const auto changes = [&](int i, double limit) {
    return std::min(limit, kHabit.change_factor * std::max(change_[i], kHabit.least_change[i]));
  };
  // The velocity is expected to be about half of the largest (predictStep).
  const auto goes = [&](int i, double limit) {
    return std::min(limit, 2.0 * std::max(kHabit.speed_factor * speed_[i], kHabit.least_speed[i]));
  };
  CarrierConfig expected = limits_;
  expected.acceleration = changes(0, limits_.acceleration);
  expected.turn_acceleration = changes(1, limits_.turn_acceleration);
  expected.max_speed = goes(0, limits_.max_speed);
  expected.max_turn_rate = goes(1, limits_.max_turn_rate);
  return expected;
}

}  // namespace sightline::dead_reckoning
