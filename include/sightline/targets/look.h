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
  /// Set and model have to outlive it.
  Look(const BearingSet& set, const SensorModel& model);

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
  /// Density of measurements of all of them [1/rad].
  double knownDensity(std::size_t measurement) const;

  /// Probability of detection by place in the sensor frame: mean over visible and hidden times.
  double detection(const Polar& place) const;
  /// Mean over a component's spread, with line of sight.
  double detection(const Component& component, const Polar& mean) const;
  /// Share of a component's spread that no wall hides [0, 1].
  double inSight(const Component& component) const;
  /// Density [1/rad] of a measurement from a predicted component: a Gaussian, and a wider one for
  /// the tails.
  double likelihood(std::size_t measurement, const BearingPrediction& prediction) const;
  /// Difference of a measurement from a predicted component [rad], and its variance [rad²] as far
  /// as it is of the one Gaussian or of the other.
  struct Innovation {
    double error;
    double variance;
  };
  Innovation innovation(std::size_t measurement, const BearingPrediction& prediction) const;

 private:
  struct Known {
    BearingPrediction prediction;
    double detection;
  };
  // One of the Gaussians of errors.
  struct ErrorPart {
    double share;
    double extra;  // variance over that of all errors together [rad²]
  };
  // Densities of an error by the parts, each with its variance.
  struct PartDensity {
    double density;
    double variance;
  };
  std::array<PartDensity, 2> partsAt(std::size_t measurement,
                                     const BearingPrediction& prediction) const;
  void splitErrors(double tail);
  double detectionAt(const Eigen::Vector2d& point_map) const;

  const BearingSet& set_;
  const SensorModel& model_;
  geometry::Pose2 T_sensor_map_;
  FieldOfView field_of_view_;
  double sigma_;
  std::array<ErrorPart, 2> parts_;
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
