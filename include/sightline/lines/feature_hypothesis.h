#pragma once

#include <Eigen/Core>

#include "sightline/geometry/feature.h"
#include "sightline/lines/carrier_step.h"
#include "sightline/lines/feature_tracker_config.h"
#include "sightline/lines/sighting.h"

namespace sightline::lines {

/// Change of the view of one feature from a scan to the next.
struct ViewChange {
  CarrierStep step;
  double elapsed = 0.0;  ///< [s]
  /// Way of the sensor across its bearing to the feature, to the left [m].
  double sideways = 0.0;
  /// Correlation of where the beams fall on a wall there with where they fell before, [0, 1].
  double beam_correlation = 0.0;
};

/// A feature under one assumption about its behaviour: a Kalman filter on four states, in the
/// frame of the base at the last scan.
///
/// - fixed: x, y, error of the odometry's scale, offset of an end between two beams
/// - sliding: x, y, way along the wall for one of the sensor across its bearing, that offset
/// - moving: x, y, vx, vy
class FeatureHypothesis {
 public:
  FeatureHypothesis(geometry::FeatureBehaviour behaviour, const FeatureTrackerConfig& config)
      : behaviour_(behaviour), config_(&config) {}

  /// Starts at a sighting.
  void start(const Sighting& sighting);
  void predict(const ViewChange& change);

  /// A sighting that is compared with the state.
  struct Innovation {
    Eigen::Vector2d residual;
    Eigen::Matrix2d covariance;
    double nis() const;
    double density() const;  ///< of such a residual [1/m²]
  };
  Innovation innovation(const Sighting& sighting) const;
  void update(const Sighting& sighting);
  /// Takes the place of another hypothesis, uncertain as a first sighting is.
  void restart(const Sighting& sighting) { start(sighting); }

  Eigen::Vector2d position() const { return state_.head<2>(); }
  Eigen::Matrix2d covariance() const { return covariance_.topLeftCorner<2, 2>(); }
  /// [m/s]; zero of things that stand still.
  Eigen::Vector2d velocity() const;
  bool isFinite() const { return state_.allFinite() && covariance_.allFinite(); }

 private:
  using Response = Eigen::Matrix<double, 2, 4>;

  bool isMoving() const { return behaviour_ == geometry::FeatureBehaviour::kMoving; }
  bool isSliding() const { return behaviour_ == geometry::FeatureBehaviour::kSliding; }
  Response responseOf(const Sighting& sighting) const;
  Eigen::Matrix2d noiseOf(const Sighting& sighting) const;
  Eigen::Matrix4d transition(const ViewChange& change) const;
  void addNoise(const ViewChange& change);
  void forgetOffset(double correlation);

  geometry::FeatureBehaviour behaviour_;
  const FeatureTrackerConfig* config_;
  Eigen::Vector4d state_ = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance_ = Eigen::Matrix4d::Zero();
  Eigen::Vector2d along_ = Eigen::Vector2d::Zero();  // the wall, at the last sighting
  double between_beams_ = 0.0;                       // variance of the offset, at the last sighting
};

}  // namespace sightline::lines
