#pragma once

#include <memory>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/targets/line_of_sight.h"
#include "sightline/targets/sensor_model_config.h"

namespace sightline::targets {

/// A point as a sensor sees it.
struct Polar {
  double range = 0.0;    ///< [m]
  double bearing = 0.0;  ///< in (−π, π] [rad]
};
Polar polarOf(const Eigen::Vector2d& point_sensor);

/// The three models of a bearing-only sensor (dames eqs 1 to 3), for simulation, fitting and
/// filtering alike. Densities are per radian.
class SensorModel {
 public:
  /// `sight` may be empty: then nothing hides a target. Throws config::Error as
  /// SensorModelConfig::check.
  explicit SensorModel(const SensorModelConfig& config = {},
                       std::shared_ptr<const LineOfSight> sight = nullptr);

  const SensorModelConfig& config() const { return config_; }

  /// Probability of detection by place in the sensor frame, dames eq. 1 or the table: mean over
  /// visible and hidden times, without line of sight.
  double detection(const Polar& target) const;
  /// p_d(x; q), dames eq. 1, with line of sight from the sensor at q.
  double detection(const Eigen::Vector2d& target_map, const geometry::Pose2& T_map_sensor) const;
  bool isInSight(const Eigen::Vector2d& target_map, const geometry::Pose2& T_map_sensor) const;
  bool isInView(const Polar& target) const;
  bool hasSight() const { return sight_ != nullptr; }

  /// g(z | x; q), dames eq. 2, wrapped: integrates to one over the circle.
  double likelihood(double bearing, const Polar& target) const;

  /// c(z; q), dames eq. 3: integrates to μ over the field of view. The formula does not depend on
  /// q.
  double clutter(double bearing, const geometry::Pose2& T_map_sensor) const;
  double clutterMean() const { return config_.clutter.mean; }

 private:
  SensorModelConfig config_;
  std::shared_ptr<const LineOfSight> sight_;
  double knee_;             // d_t / θ_sep [m]
  double uniform_density_;  // of clutter [1/rad]
  double peak_density_;     // [1/rad]
};

/// Range of the knee of eq. 1, from which on beams pass a target by: d_t / θ_sep [m].
double kneeRange(const DetectionConfig& detection);

}  // namespace sightline::targets
