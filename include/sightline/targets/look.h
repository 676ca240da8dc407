#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sightline/targets/bernoulli.h"
#include "sightline/targets/undetected.h"

namespace sightline::targets {

/// One set of bearings as a filter weighs it: the model as it holds for this look.
class Look {
 public:
  /// What the bearings of this look have in common, as far as the others tell: mean [rad] and
  /// variance [rad²].
  struct Offset {
    double mean;
    double variance;
  };
  /// Difference of a measurement from a predicted component [rad], and its variance [rad²] as far
  /// as it is of the one Gaussian or of the other.
  struct Innovation {
    double error;
    double variance;
  };

  /// Set and model have to outlive it. `pose_duration`: time constant after which a robot's pose
  /// has other errors [s].
  Look(const BearingSet& set, const SensorModel& model, double pose_duration = 20.0);

  const BearingSet& set() const { return set_; }
  const SensorModel& model() const { return model_; }
  const geometry::UncertainPose2& pose() const { return set_.T_map_sensor; }
  const FieldOfView& fieldOfView() const { return field_of_view_; }
  /// Standard deviation of a bearing, tails included [rad].
  double sigma() const { return sigma_; }
  std::size_t size() const { return bearings_.size(); }
  /// Bearing without the sensor's bias and what its lag makes of the robot's turning [rad].
  double bearing(std::size_t measurement) const { return bearings_[measurement]; }
  /// Density of clutter at a measurement [1/rad].
  double clutter(std::size_t measurement) const { return clutter_[measurement]; }

  /// Known things that are no targets, such as robots: a weight of being a measurement, p_d g, over
  /// that of being missed, 1 − p_d.
  std::size_t knownCount() const { return known_.size(); }
  double knownRatio(std::size_t known, std::size_t measurement) const;
  double knownRatio(std::size_t known, std::size_t measurement, const Offset& offset) const;
  Innovation knownInnovation(std::size_t known, std::size_t measurement) const {
    return innovation(measurement, known_[known].prediction);
  }
  /// Density of measurements of all of them [1/rad].
  double knownDensity(std::size_t measurement) const;

  /// Probability of detection by place in the sensor frame: mean over visible and hidden times.
  double detection(const Polar& place) const;
  /// Mean over a component's spread, with line of sight.
  double detection(const Component& component, const Polar& mean) const;
  /// Share of a component's spread that no wall hides [0, 1].
  double inSight(const Component& component) const;
  /// Bearing of a component as the set's pose and the sensor's errors leave it, what lasts of them
  /// as the component shares it.
  BearingPrediction predict(const Component& component) const;
  /// Covariance of a place at that range along a bearing, known by it alone, with the errors that
  /// last.
  SharedCovariance sharedAlong(double range, double bearing) const;
  /// Whether any error lasts over looks.
  bool lasts() const { return lasts_; }
  /// Makes a target's covariances with this robot's errors those of now.
  void age(Bernoulli& bernoulli) const;

  /// Its variance before any bearing is looked at [rad²].
  double commonVariance() const { return common_variance_; }
  /// Of what a bearing does not share with the others of its look [rad²].
  double ownVariance() const { return own_ * sigma_ * sigma_; }
  /// Density [1/rad] of a measurement from a predicted component: a Gaussian, and a wider one for
  /// the tails.
  double likelihood(std::size_t measurement, const BearingPrediction& prediction) const;
  double likelihood(std::size_t measurement, const BearingPrediction& prediction,
                    const Offset& offset) const;
  Innovation innovation(std::size_t measurement, const BearingPrediction& prediction) const;

 private:
  struct Known {
    BearingPrediction prediction;
    double detection;
  };
  // One of the Gaussians of errors.
  struct ErrorPart {
    double share;
    double extra;  // variance over that of all errors together, were all of it independent [rad²]
  };
  // Densities of an error by the parts, each with its variance.
  struct PartDensity {
    double density;
    double variance;
  };
  std::array<PartDensity, 2> partsOf(double error, double variance, double share) const;
  std::array<PartDensity, 2> partsAt(std::size_t measurement,
                                     const BearingPrediction& prediction) const;
  void splitErrors(double tail);
  void shareErrors(const BearingConfig& errors, double pose_duration);
  double detectionAt(const Eigen::Vector2d& point_map) const;

  const BearingSet& set_;
  const SensorModel& model_;
  geometry::Pose2 T_sensor_map_;
  FieldOfView field_of_view_;
  double sigma_;
  std::array<ErrorPart, 2> parts_;
  bool lasts_ = false;
  Eigen::Matrix3d pose_root_;     // Cholesky factor of the pose's covariance
  double lasting_sigma_ = 0.0;    // of the sensor [rad]
  double common_variance_ = 0.0;  // [rad²]
  double apart_ = 1.0;            // share of the sensor's variance that does not last
  double own_ = 1.0;              // share that a bearing does not have in common with others
  std::array<double, 2> durations_ = {};  // of errors of the pose and of the sensor [s]
  std::vector<double> bearings_;
  std::vector<double> clutter_;
  std::vector<Known> known_;
};

/// What a bearing says of targets that nobody has detected yet: Gaussians along it.
struct Birth {
  double mass = 0.0;  ///< ∫ λ_u p_d g dx [1/rad]
  Mixture mixture;    ///< weights sum to one
};

/// `count` Gaussians, log-spaced in range from `nearest` [m] to the end of the sensor's range, each
/// as heavy as the undetected targets that it stands for.
Birth birthAlong(const Look& look, std::size_t measurement, const Undetected& undetected, int count,
                 double nearest);

}  // namespace sightline::targets
