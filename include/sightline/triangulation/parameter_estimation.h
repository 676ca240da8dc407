#pragma once

#include <string>
#include <vector>

#include "sightline/triangulation/calibration_residuals.h"

namespace sightline::triangulation {

/// Outcome of calibrating a sensor.
struct ParameterEstimate {
  Intrinsics intrinsics;
  ScanOrigin origin;
  /// Covariance of the parameters in the order of toVector(): inverse of the information matrix.
  Eigen::Matrix<double, kParameterCount, kParameterCount> covariance;

  std::vector<ImageReading> images;  ///< that were used, without the shift by the beam's width
  std::vector<StripeEdge> edges;     ///< that were found; sigmas include edge_scatter
  Eigen::VectorXd residuals;         ///< of the images, then of the edges, in standard deviations
  /// Scatter of edges beyond the noise of the currents [m], lateral: of how well they are made and
  /// how far the beam is from Gaussian. Estimated from the edges themselves.
  double edge_scatter = 0.0;

  double sigma(int parameter) const;
  double imageRms() const;  ///< of the residuals of image position [m]
  double edgeRms() const;   ///< of those of the edges, lateral, at their depth [m]
  /// Sum of squared residuals over degrees of freedom: about 1 where the model and the noise
  /// current are right.
  double reducedChiSquare() const;
};

/// Estimates f, d, γ, s, the scan origin and the projected vergence jointly, by non-linear least
/// squares over plain and striped targets; image positions have the noise of pears eq. 2. Starts
/// from linear least squares, or from the nominal sensor where that fits better. Only the edges of
/// the striped targets are used: between them an image position says what those of the plain
/// ones say, and near one the stripes pull the centroid of the light.
///
/// `nominal` is what the sensor was built to be: its scan, its detector and its noise current are
/// taken as they are, its geometry says which stripe is which. `beam_width` [m] is between the 1/e²
/// points.
///
/// Throws config::Error naming `source`: for parameters that the recording does not determine, by
/// name (to a tenth of f, d and γ, 5 mm of s and the origin, 1° of the projected vergence), and
/// where no sensor with parameters in their ranges fits it best.
ParameterEstimate estimateParameters(const CalibrationRecording& recording,
                                     const SensorParameters& nominal, double beam_width,
                                     const std::string& source = "");

}  // namespace sightline::triangulation
