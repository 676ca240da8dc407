#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/targets/bearing_set.h"
#include "sightline/targets/sensor_model.h"

namespace sightline::targets {

/// What a Gaussian of a mixture stands for.
enum class Mode {
  kStanding,  ///< a target that stands still
  kMoving,    ///< a target that walks at random
  kGlint,     ///< no target: a surface that shines towards one side, such as a sheet of metal
  kFaint,     ///< no target: something that is seldom seen, from any side, such as a metal pole
  kMate,      ///< no target: a robot of the team whose pose does not come any more
};
inline bool isTarget(Mode mode) {
  return mode == Mode::kStanding || mode == Mode::kMoving;
}

/// Covariance of a place with the errors that the looks of one robot share for a while, each in its
/// standard deviations: of the pose in x, y and heading, by the Cholesky factor of its covariance,
/// and of the sensor [m].
using SharedCovariance = Eigen::Matrix<double, 2, 4>;

/// A Gaussian of a mixture.
struct Component {
  double weight = 1.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();            ///< in the map [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< [m²]
  Mode mode = Mode::kStanding;
  double facing = 0.0;  ///< of a glint: direction in the map from it to who saw it first [rad]
  /// By robot. The errors themselves are not estimated, but accounted for (Schmidt 1966): looks
  /// that err alike do not make a place as sure as if each erred by itself.
  std::vector<SharedCovariance> shared = {};
};
using Mixture = std::vector<Component>;

/// Whether a robot can see a target at present, as it has seen or missed it before.
struct Visibility {
  double probability = 1.0;
  std::int64_t stamp = 0;  ///< [ns]
};

/// A target, or something that is taken for one, that may exist.
struct Bernoulli {
  double existence = 0.0;   ///< probability that there is something, target or not [0, 1]
  Mixture mixture;          ///< weights sum to one
  std::int64_t stamp = 0;   ///< to which it has been predicted [ns]
  std::uint32_t label = 0;  ///< 0: never reported yet
  std::vector<Visibility> visibility;       ///< by robot
  std::vector<std::int64_t> shared_stamps;  ///< by robot, of the covariances with its errors [ns]
  std::optional<std::size_t> mate;          ///< the robot that it is, where it is one
};

/// Bearing of a point from an uncertain pose, linearised.
struct BearingPrediction {
  Polar polar;                ///< of the component's mean
  Eigen::RowVector2d slope;   ///< H, by the place [rad/m]
  Eigen::Vector2d gain;       ///< P Hᵀ, and of the shared errors [m rad]
  double variance = 0.0;      ///< of the innovation: point, pose and sensor [rad²]
  std::size_t robot = 0;      ///< whose shared errors these are
  Eigen::RowVector4d shared;  ///< the bearing by its robot's shared errors; 0 where none are [rad]
};

/// Bearing of a point and its derivatives by point and by pose (x, y, θ).
struct BearingJacobians {
  Polar polar;
  Eigen::RowVector2d point;
  Eigen::RowVector3d pose;
};
BearingJacobians bearingJacobians(const Eigen::Vector2d& point_map,
                                  const geometry::Pose2& T_map_sensor);

/// `sigma` [rad]: of all errors of the sensor. Without what looks share: errors are of this one.
BearingPrediction predictBearing(const Component& component,
                                 const geometry::UncertainPose2& T_map_sensor, double sigma);
/// The component after a bearing that differs by `innovation` [rad] from the predicted one, whose
/// variance the prediction tells.
Component updated(const Component& component, const BearingPrediction& prediction,
                  double innovation);

/// Merges components that lie within `distance` (Mahalanobis, squared) of a heavier one in the same
/// mode, drops those lighter than `least`, keeps the `most` heaviest of targets and as many of
/// other things, and makes the weights sum to one.
void reduce(Mixture& mixture, double distance, double least, std::size_t most);

/// Mean and covariance of a mixture.
UncertainPoint momentsOf(const Mixture& mixture);
/// The mixture as it is if it is of a target: weights sum to one; empty where it can be none.
Mixture ofTarget(const Mixture& mixture);
/// Share of a mixture that stands for something [0, 1].
double shareOf(const Mixture& mixture, Mode mode);
/// Probability that there is a target.
double targetExistence(const Bernoulli& bernoulli);

}  // namespace sightline::targets
