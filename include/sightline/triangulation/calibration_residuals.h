#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "sightline/triangulation/calibration.h"
#include "sightline/triangulation/stripe_edges.h"

namespace sightline::triangulation {

/// Number of parameters that calibration estimates, in the order of its vectors: f [m], d [m], γ
/// [rad], s [m], x and y of the scan's origin [m], projected vergence [rad].
constexpr int kParameterCount = 7;
using ParameterVector = Eigen::Matrix<double, kParameterCount, 1>;
struct ParameterName {
  const char* key;   ///< as in a calibration file
  const char* unit;  ///< SI
};
extern const std::array<ParameterName, kParameterCount> kParameterNames;

ParameterVector toVector(const Intrinsics& intrinsics, const ScanOrigin& origin);
/// Writes all but the detector's length.
void fromVector(const ParameterVector& parameters, Intrinsics& intrinsics, ScanOrigin& origin);

/// The image of a plain target, as the axis of the beam alone would give it.
struct ImageReading {
  double depth = 0.0;           ///< [m], sensor frame
  double scan_angle = 0.0;      ///< [rad]
  double image_position = 0.0;  ///< [m]
  double sigma = 0.0;           ///< [m]
};

/// Differences between readings and what parameters predict, in standard deviations.
///
/// Plain targets bear on image position, pears eq. 10. They say next to nothing of y: moving the
/// origin along a flat target changes neither range nor angle. Striped targets say where the origin
/// is and where the scan points: an edge at (z, y) is seen at the scan angle
/// atan2(y − y₀, z − x₀) − γᵖ.
class CalibrationResiduals {
 public:
  CalibrationResiduals(std::vector<ImageReading> images, std::vector<StripeEdge> edges,
                       double detector_length);

  Eigen::Index size() const;
  /// Residuals of images, then of edges: measured less predicted, over sigma. Throws config::Error
  /// for intrinsics outside their range.
  Eigen::VectorXd at(const ParameterVector& parameters) const;
  /// ∂ residuals / ∂ parameters.
  Eigen::Matrix<double, Eigen::Dynamic, kParameterCount> jacobianAt(
      const ParameterVector& parameters) const;

  const std::vector<ImageReading>& images() const { return images_; }
  const std::vector<StripeEdge>& edges() const { return edges_; }

 private:
  std::vector<ImageReading> images_;
  std::vector<StripeEdge> edges_;
  double detector_length_;
};

}  // namespace sightline::triangulation
