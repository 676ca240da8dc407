#pragma once

#include <vector>

#include "sightline/targets/labelling.h"

namespace sightline::targets {

/// Share of detections by range.
struct RangeBin {
  double range = 0.0;  ///< of its middle [m]
  double tried = 0.0;
  double detected = 0.0;
  double share() const { return detected / tried; }
};
/// Bins of `width` [m] from 0 on; those without an opportunity are left out.
std::vector<RangeBin> binByRange(const std::vector<Opportunity>& opportunities, double width = 0.2);

/// Detection model of least squares (dames section 3.1): p_fn over 0:0.005:1, d_t over 0:0.01:2 in.
struct DetectionFit {
  double false_negative = 0.0;
  double target_diameter = 0.0;  ///< [m]
  double error = 0.0;            ///< sum of squares
};
DetectionFit fitDetection(const std::vector<RangeBin>& bins, double beam_spacing);

/// Density of clutter bearings by bins of π/20 over a field of view [1/rad], for one measurement.
struct ClutterBin {
  double from = 0.0;  ///< [rad]
  double to = 0.0;
  double density = 0.0;
};
std::vector<ClutterBin> binClutter(const std::vector<ClutterBearing>& clutter,
                                   const FieldOfView& view);

/// Clutter model of least squares (dames section 3.3): θ_c over 0:π/400:π/2, p_u over 0:0.005:1,
/// compared by its mean over each bin.
struct ClutterFit {
  double peak_width = 0.0;
  double uniform_share = 1.0;
  double error = 0.0;
};
ClutterFit fitClutter(const std::vector<ClutterBin>& bins, const FieldOfView& view);

/// A point of figure 6: the fit at one σ.
struct SigmaPoint {
  double sigma = 0.0;         ///< [rad]
  double error = 0.0;         ///< sum of squares of the detection model
  double inlier_share = 0.0;  ///< of the measurements
};
/// Labels anew at each σ.
std::vector<SigmaPoint> sweepSigma(const std::vector<KnownLook>& looks,
                                   const std::vector<Eigen::Vector2d>& targets_map,
                                   LabellingConfig config, double beam_spacing,
                                   const std::vector<double>& sigmas);

}  // namespace sightline::targets
