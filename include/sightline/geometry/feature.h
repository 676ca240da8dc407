#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace sightline::geometry {

/// Thing that a feature is; values as in Feature.msg.
enum class FeatureKind : std::uint8_t {
  kCorner = 1,   ///< two walls meet
  kEdge = 2,     ///< a wall ends, and what lies behind is seen past it
  kLineEnd = 3,  ///< something nearer hides the rest of a wall
  kArc = 4,      ///< centre of something round
};

/// Behaviour under the carrier's motion; values as in Feature.msg.
enum class FeatureBehaviour : std::uint8_t {
  kUndecided = 0,
  kFixed = 1,
  kSliding = 2,  ///< moves along its wall as the viewpoint moves: a border of the view
  kMoving = 3,
};

/// A distinct place that scans have shown again and again, in `odom` as it is at the last scan.
struct Feature {
  std::uint32_t id = 0;  ///< never 0, and never given twice
  FeatureKind kind = FeatureKind::kCorner;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();    ///< [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the position [m²]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();    ///< [m/s]; 0 unless it moves
  FeatureBehaviour behaviour = FeatureBehaviour::kUndecided;
  double fixed_probability = 0.0;    ///< [0, 1]
  double sliding_probability = 0.0;  ///< [0, 1]
  double moving_probability = 0.0;   ///< [0, 1]; the three add up to 1
  double age = 0.0;                  ///< since it was first seen [s]
  double unseen = 0.0;               ///< since it was last seen [s]
  std::uint32_t sightings = 0;       ///< scans that showed it
};

}  // namespace sightline::geometry
