#include "sightline/simulation/turret.h"

namespace sightline::simulation {

namespace {

constexpr std::int64_t kStep = 1'000'000;  // [ns]: small against the time to full rate

}  // namespace

Turret::Turret(const motion::HeadLimits& limits) : head_(limits) {
  turned_.add(0, {0.0, 0.0, head_.angle()});
}

void Turret::turnUntil(std::int64_t time) {
  for (std::int64_t at = turned_.newest() + kStep; at <= time; at += kStep) {
    head_.step(1e-9 * static_cast<double>(kStep));
    turned_.add(at, {0.0, 0.0, head_.angle()});
  }
}

double Turret::angleAt(std::int64_t time) const {
  const auto pose = turned_.at(time);
  return pose ? pose->theta() : head_.angle();
}

}  // namespace sightline::simulation
