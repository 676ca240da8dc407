#pragma once

#include <Eigen/Core>

#include "sightline/config/fields.h"
#include "sightline/scan/scan.h"

namespace sightline::scan {

enum class NoiseKind {
  kConstant,      ///< the same standard deviation along every beam
  kProportional,  ///< a constant part and a part that grows with the range
  kUniform,       ///< uniform in range and angle, as a quantising scanner (jensfelt eqs 2-4)
  kIsotropic,     ///< the same in every direction of the plane (jensfelt's runs: 50 mm)
  kIntensity,     ///< a constant part and a part that falls with the intensity (pears eq. 2 scaled)
  kEstimated,     ///< learned from scans (learned_noise.h), for a scanner that nobody knows
};

/// Accuracy of a beam.
struct NoiseModel {
  NoiseKind kind = NoiseKind::kConstant;
  double sigma = 0.01;              ///< [m]; kEstimated: until scans show it
  double least_sigma = 0.002;       ///< kEstimated: [m]
  double sigma_per_metre = 0.0;     ///< kProportional
  double range_half_width = 0.025;  ///< kUniform: Δr [m]
  double angle_half_width = 0.0;    ///< kUniform: Δα [rad]
  double intensity_sigma = 0.0;     ///< kIntensity: sigma times intensity [m · unit of intensity]
  double angular_sigma = 0.0;       ///< of a beam's direction, any kind but kUniform [rad]

  void visit(config::FieldVisitor& visitor);

  /// Variance along the beam [m²]. Positive; intensity only matters to kIntensity.
  double rangeVariance(double range, double intensity = 0.0) const;
  /// Variance of the beam's direction [rad²].
  double angularVariance() const;
};

/// Covariance of the Cartesian point of a beam whose range is uniform within ±Δr of r and whose
/// angle is uniform within ±Δα of α (jensfelt eqs 2-4; eq. 4 as corrected, see docs/Sources.md).
Eigen::Matrix2d uniformCovariance(double range, double angle, double range_half_width,
                                  double angle_half_width);

/// Fills the variances of a scan. kEstimated: from this scan alone; LearnedNoise remembers.
void applyNoise(const NoiseModel& model, Scan& scan);

}  // namespace sightline::scan
