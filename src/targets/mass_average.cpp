#include "sightline/targets/mass_average.h"

#include <algorithm>
#include <cmath>

namespace sightline::targets {

namespace {

// Mass below which a cell is forgotten.
constexpr double kNothing = 1e-5;

// Sums over the cells within a radius of a place.
struct PeakSums {
  double mass = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();

  void add(double weight, const Eigen::Vector2d& place) {
    mass += weight;
    moment += weight * place;
    scatter += weight * place * place.transpose();
  }
  Eigen::Vector2d mean() const { return moment / mass; }
  Eigen::Matrix2d covariance() const { return scatter / mass - mean() * mean().transpose(); }
};

}  // namespace

void MassAverageConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("resolution", resolution, {"m", {0.01, 5.0}, "cells over which mass is averaged"});
  visitor.integer("looks", looks,
                  {"-", {1, 1000}, "looks with a cell in view over which its mass is averaged"});
  visitor.number("radius", radius, {"m", {0.05, 50.0}, "of the mass that is taken for one target"});
  visitor.number("least", least, {"1", {0.01, 1.0}, "averaged mass from which on it is a target"});
}

std::int64_t MassAverage::keyOf(const Eigen::Vector2d& place) const {
  const auto x = static_cast<std::int64_t>(std::floor(place.x() / config_.resolution));
  const auto y = static_cast<std::int64_t>(std::floor(place.y() / config_.resolution));
  return x * (std::int64_t{1} << 32) + y;  // x may be negative: no shift
}

Eigen::Vector2d MassAverage::centreOf(std::int64_t key) const {
  const auto y = static_cast<std::int32_t>(key & 0xffffffff);
  const std::int64_t x = (key - y) >> 32;
  return config_.resolution * Eigen::Vector2d(static_cast<double>(x) + 0.5, y + 0.5);
}

void MassAverage::settle(Cell& cell) const {
  cell.looks = std::min(cell.looks + 1, config_.looks);
  const double share = 1.0 / cell.looks;
  cell.average.mass += share * (cell.now.mass - cell.average.mass);
  cell.average.moment += share * (cell.now.moment - cell.average.moment);
}

void MassAverage::add(const Look& look, const std::vector<Particle>& particles) {
  for (const Particle& particle : particles) {
    Mass& now = cells_[keyOf(particle.place)].now;
    now.mass += particle.weight;
    now.moment += particle.weight * particle.place;
  }
  const geometry::Pose2 T_sensor_map = look.pose().mean.inverse();
  for (auto cell = cells_.begin(); cell != cells_.end();) {
    const bool is_new = cell->second.looks == 0;
    if (is_new || look.detection(polarOf(T_sensor_map * centreOf(cell->first))) > 0.0) {
      settle(cell->second);
    }
    cell->second.now = {};
    cell = cell->second.average.mass < kNothing ? cells_.erase(cell) : std::next(cell);
  }
}

std::vector<MassAverage::Mass> MassAverage::heaviestFirst() const {
  std::vector<Mass> masses;
  for (const auto& [key, cell] : cells_) masses.push_back(cell.average);
  std::sort(masses.begin(), masses.end(), [](const Mass& a, const Mass& b) {
    return a.mass != b.mass ? a.mass > b.mass : a.moment.x() < b.moment.x();
  });
  return masses;
}

std::uint32_t MassAverage::labelOf(const Eigen::Vector2d& place, std::vector<Target>& before) {
  const auto same = std::find_if(before.begin(), before.end(), [&](const Target& target) {
    return (target.mean - place).norm() < config_.radius;
  });
  if (same == before.end()) return ++labels_;
  const std::uint32_t label = same->label;
  before.erase(same);
  return label;
}

std::vector<Target> MassAverage::targets() {
  constexpr int kShifts = 4;
  std::vector<Mass> masses = heaviestFirst();
  std::vector<Target> found;
  while (!masses.empty() && masses.front().mass > 0.01 * config_.least) {
    Eigen::Vector2d centre = masses.front().moment / masses.front().mass;
    PeakSums sums;
    const auto is_near = [&](const Mass& mass) {
      return (mass.moment / mass.mass - centre).norm() < config_.radius;
    };
    for (int i = 0; i < kShifts; ++i, centre = sums.mean()) {
      sums = {};
      for (const Mass& mass : masses) {
        if (is_near(mass)) sums.add(mass.mass, mass.moment / mass.mass);
      }
      if (sums.mass == 0.0) break;
    }
    if (sums.mass >= config_.least) {
      found.push_back(
          {labelOf(centre, targets_), centre, sums.covariance(), std::min(sums.mass, 1.0), 0.0});
    }
    // The cell that it began with goes in any case, so that this ends.
    masses.erase(masses.begin());
    masses.erase(std::remove_if(masses.begin(), masses.end(), is_near), masses.end());
  }
  targets_ = found;
  return found;
}

}  // namespace sightline::targets
