#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/targets/look.h"
#include "sightline/targets/target_filter.h"

namespace sightline::targets {

/// A weighted sample of a density over the plane.
struct Particle {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< in the map [m]
  double weight = 0.0;
};

/// Settings of MassAverage.
struct MassAverageConfig {
  double resolution = 0.1;  ///< of the grid [m]
  int looks = 24;           ///< over which the mass is averaged
  double radius = 0.6;      ///< of what is taken for one target [m]
  double least = 0.5;       ///< averaged mass of a target

  void visit(config::FieldVisitor& visitor);
};

/// The mass of a PHD by cells, averaged over the looks that had a cell in view, and its peaks as
/// targets.
class MassAverage {
 public:
  explicit MassAverage(const MassAverageConfig& config) : config_(config) {}

  /// Particles after a look.
  void add(const Look& look, const std::vector<Particle>& particles);
  /// Peaks, the heaviest first, each with the covariance of the mass around it. Labels stay with
  /// places.
  std::vector<Target> targets();

 private:
  /// Mass and its first moment.
  struct Mass {
    double mass = 0.0;
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  };
  struct Cell {
    Mass now;  // of the present look
    Mass average;
    int looks = 0;  // that had it in view
  };
  std::int64_t keyOf(const Eigen::Vector2d& place) const;
  Eigen::Vector2d centreOf(std::int64_t key) const;
  void settle(Cell& cell) const;
  std::vector<Mass> heaviestFirst() const;
  std::uint32_t labelOf(const Eigen::Vector2d& place, std::vector<Target>& before);

  MassAverageConfig config_;
  std::unordered_map<std::int64_t, Cell> cells_;
  std::vector<Target> targets_;
  std::uint32_t labels_ = 0;
};

}  // namespace sightline::targets
