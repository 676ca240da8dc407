#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sightline/targets/bearing_set.h"
#include "sightline/targets/sensor_model.h"

namespace sightline::targets {

/// A target that a filter reports.
struct Target {
  std::uint32_t label = 0;                                   ///< from 1, stays with it
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();            ///< in the map [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< [m²]
  double probability = 0.0;                                  ///< of being there
  double moving = 0.0;                                       ///< probability that it moves
};

struct TargetEstimate {
  std::int64_t stamp = 0;  ///< of the newest set [ns]
  std::vector<Target> targets;
  double expected_number = 0.0;      ///< of targets that have been detected
  double number_variance = 0.0;      ///< of that number
  double expected_undetected = 0.0;  ///< where robots have looked or been near
};

/// Density of targets [1/m²] over cells, row-major, x first.
struct IntensityGrid {
  double resolution = 0.0;                           ///< edge of a cell [m]
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< corner of cell (0, 0) in the map [m]
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<double> cells;
};

/// Estimates the number of targets and their places from sets of bearings of any number of robots,
/// taken in the order of their stamps. Not thread-safe.
class TargetFilter {
 public:
  virtual ~TargetFilter() = default;
  /// `model` is that of the set's robot. Sets are finite and within the model's ranges.
  virtual void update(const BearingSet& set, const SensorModel& model) = 0;
  virtual TargetEstimate estimate() = 0;
  /// Density of targets that are detected or not, for people to look at.
  virtual IntensityGrid intensity() const = 0;
};

}  // namespace sightline::targets
