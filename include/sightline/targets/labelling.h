#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/targets/sensor_model.h"

namespace sightline::targets {

/// A look from a known pose in a place with known targets.
struct KnownLook {
  std::size_t robot = 0;
  std::int64_t stamp = 0;        ///< [ns]
  geometry::Pose2 T_map_sensor;  ///< true, or as good as known
  double turn_rate = 0.0;        ///< of the sensor [rad/s]
  std::vector<double> bearings;
  std::vector<Eigen::Vector2d> mates_map;  ///< other robots
};

/// A target in the field of view of a look: a detection, or a miss.
struct Opportunity {
  std::size_t look = 0;
  std::size_t target = 0;
  Polar place;
  bool is_detected = false;
  double error = 0.0;  ///< measured less true bearing, of a detection [rad]
};

/// A bearing that is of no target.
struct ClutterBearing {
  std::size_t look = 0;
  double bearing = 0.0;
  bool is_mate = false;  ///< whether another robot stands there
};

struct Labels {
  std::vector<Opportunity> opportunities;
  std::vector<ClutterBearing> clutter;
  std::size_t detected = 0;
  std::size_t measurements = 0;
};

enum class LabellingMethod {
  kNearest,  ///< the paper's: the nearest pair first
  kOptimal,  ///< the most pairs with the least squared errors together
};

/// Region in which targets are looked for, and the way measurements are given to them.
struct LabellingConfig {
  FieldOfView field_of_view;
  double range_min = 0.0;                  ///< [m]
  double range_max = 5.0;                  ///< [m]
  double sigma = geometry::radians(2.25);  ///< [rad]
  double gate = 3.0;                       ///< of errors, in σ (dames section 3.1)
  double bias = 0.0;                       ///< measured less true bearing [rad]
  double lag = 0.0;     ///< time that looks are stamped late, made good by the turn rate [s]
  double jitter = 0.0;  ///< standard deviation of that time [s]
  std::optional<DistortionConfig> distortion;  ///< of the sensor, besides its bias
  LabellingMethod method = LabellingMethod::kOptimal;
  /// Tells targets that a wall hides, which are no misses; none: nothing hides a target.
  std::shared_ptr<const LineOfSight> sight = nullptr;

  double biasAt(double bearing) const {
    return bias + (distortion ? distortion->at(bearing) : 0.0);
  }
  /// Farthest error of a bearing that is of a target [rad].
  double gateOf(const KnownLook& look) const {
    return gate * std::hypot(sigma, jitter * look.turn_rate);
  }
};

/// Gives each target in view one measurement at most, and each measurement one target at most.
Labels label(const std::vector<KnownLook>& looks, const std::vector<Eigen::Vector2d>& targets_map,
             const LabellingConfig& config);

}  // namespace sightline::targets
