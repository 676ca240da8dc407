#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/targets/target_filter.h"

namespace sightline::targets {

/// Targets that nobody has detected yet.
struct UndetectedConfig {
  double prior = 0.05;       ///< density before any look [1/m²]
  double floor = 1e-4;       ///< density that no look takes away [1/m²]
  double resolution = 0.5;   ///< of the grid [m]
  std::vector<double> area;  ///< x_min, y_min, x_max, y_max: no targets elsewhere; empty: all [m]

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error naming `source` where the area is none.
  void check(const std::string& source) const;
};

/// Intensity of the Poisson process of undetected targets on a grid that grows with where robots
/// go: each look leaves (1 − p_d) of it, down to a floor, as looks from one place are not
/// independent.
class Undetected {
 public:
  explicit Undetected(const UndetectedConfig& config);

  double at(const Eigen::Vector2d& point_map) const;  ///< [1/m²]
  /// A look that detects none of them, from a sensor of this model at a place.
  void look(const geometry::Pose2& T_map_sensor, const SensorModel& model,
            const FieldOfView& field_of_view);
  /// Returns some of a target's mass that is no longer kept apart.
  void add(const Eigen::Vector2d& point_map, double mass);
  /// Makes the grid hold all within a radius [m] of a place.
  void cover(const Eigen::Vector2d& centre_map, double radius);
  double mass() const;  ///< expected number on the grid
  const IntensityGrid& grid() const { return grid_; }

 private:
  struct Span {
    std::size_t first;
    std::size_t end;
  };
  bool isInside(const Eigen::Vector2d& point_map) const;
  double priorAt(const Eigen::Vector2d& point_map) const;
  void reshape(const Eigen::Vector2d& low, const Eigen::Vector2d& high);
  std::optional<std::size_t> cellOf(const Eigen::Vector2d& point_map) const;
  Eigen::Vector2d centreOf(std::size_t column, std::size_t row) const;
  Span columnsWithin(double low, double high) const;
  Span rowsWithin(double low, double high) const;

  UndetectedConfig config_;
  IntensityGrid grid_;
};

}  // namespace sightline::targets
