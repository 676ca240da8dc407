#include "sightline/simulation/mover.h"

#include <cmath>

namespace sightline::simulation {

namespace {

constexpr double kWalkersAcceleration = 1.0;      // [m/s²]
constexpr double kWalkersTurnAcceleration = 4.0;  // [rad/s²]

DriveLimits limitsOf(const Path& path) {
  return {path.speed, path.turn_rate, kWalkersAcceleration, kWalkersTurnAcceleration};
}

}  // namespace

Mover::Mover(const Path& path, const geometry::Pose2& T_map_start)
    : drive_(limitsOf(path), T_map_start),
      follower_(path, kWalkersAcceleration),
      departure_(std::llround(1e9 * path.wait)) {
  history_.add(time_, T_map_start);
}

void Mover::moveTo(std::int64_t time) {
  const Velocity wanted = time_ < departure_ ? Velocity{} : follower_.steer(drive_.T_map_base());
  drive_.step(wanted, 1e-9 * static_cast<double>(time - time_));
  time_ = time;
  history_.add(time_, drive_.T_map_base());
}

}  // namespace sightline::simulation
