#include "sightline/simulation/bumps.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace sightline::simulation {

void BumpConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("share", share,
                 {"1", {0.0, 0.99}, "of the way on which the robot is tilted by a bump"});
  visitor.number("length", length, {"m", {1e-3, 1e3}, "mean length of a bump along the way"});
  visitor.number("height", height, {"m", {0.0, 0.1}, "of a bump (dames section 3.4)"});
  visitor.number("wheel_base", wheel_base,
                 {"m", {0.01, 10.0}, "from the lifted wheel to the point that it turns about"});
}

Bumps::Bumps(const BumpConfig& config, std::uint64_t seed)
    : config_(config), random_(randomStream(seed, 5)) {
  enter(std::bernoulli_distribution(config_.share)(random_));
}

double Bumps::drawLength(double mean) {
  return std::exponential_distribution<double>(1.0 / mean)(random_);
}

void Bumps::enter(bool is_bump) {
  is_bump_ = is_bump;
  const double even = config_.length * (1.0 - config_.share) / config_.share;
  left_ = drawLength(is_bump ? config_.length : even);
  const bool is_forward = std::bernoulli_distribution(0.5)(random_);
  const double tilt = std::asin(std::min(1.0, config_.height / config_.wheel_base));
  pitch_ = !is_bump ? 0.0 : is_forward ? tilt : -tilt;
}

void Bumps::advance(double distance) {
  for (left_ -= distance; left_ < 0.0;) {
    const double beyond = -left_;
    enter(!is_bump_);
    left_ -= beyond;
  }
}

}  // namespace sightline::simulation
