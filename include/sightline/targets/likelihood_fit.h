#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "sightline/targets/labelling.h"
#include "sightline/targets/paper_fit.h"

namespace sightline::targets {

/// A parameter by maximum likelihood with its 95 % interval (profile likelihood).
struct Fitted {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  bool is_determined = false;  ///< false: the interval is not closed, the value means nothing
};

/// Detection model, dames eq. 1, and whether it holds.
struct DetectionLikelihood {
  Fitted false_negative;
  Fitted target_diameter;  ///< [m]
  double deviance = 0.0;   ///< of the model against the shares by range and bearing
  double limit = 0.0;      ///< that a model which holds exceeds once in a thousand
  bool isRefused() const { return deviance > limit; }
};
/// `inflation` (1 or more): variance of counts over that of independent looks.
DetectionLikelihood fitDetectionLikelihood(const std::vector<Opportunity>& opportunities,
                                           double beam_spacing, double inflation);

/// Clutter model, dames eq. 3.
struct ClutterLikelihood {
  Fitted mean;
  Fitted peak_width;
  Fitted uniform_share;
};
/// Peaks beyond the field of view, or none that stand out, leave width and share undetermined.
ClutterLikelihood fitClutterLikelihood(const std::vector<ClutterBearing>& clutter,
                                       const FieldOfView& view, std::size_t looks);

/// Measurement model, dames eq. 2, with what real sensors need besides.
struct ErrorFit {
  double sigma = 0.0;      ///< of the core [rad]
  double bias = 0.0;       ///< mean over detections [rad]
  double lag = 0.0;        ///< [s]
  double lag_sigma = 0.0;  ///< standard deviation of the lag [s]
  double jitter = 0.0;     ///< standard deviation of the lag from look to look [s]
  double tail = 1.0;       ///< standard deviation of all errors over that of the core
  std::size_t used = 0;
  std::optional<DistortionConfig> distortion;  ///< where errors depend on the bearing

  double biasAt(double bearing) const {
    return bias + (distortion ? distortion->at(bearing) : 0.0);
  }
  /// Standard deviation of all errors of a look at that turn rate [rad/s] [rad].
  double sigmaAt(double turn_rate) const { return std::hypot(sigma * tail, jitter * turn_rate); }
};
/// A Gaussian, one 2.5 times as wide and an even background by expectation maximisation, within
/// `gate` [rad]; bias, lag and distortion by regression of errors on the turn rate and, where that
/// pays, on three powers of the bearing. Errors are those of labels without bias, lag, distortion.
/// Where errors grow with the turn rate, stamps jitter: σ is that of a sensor at rest.
ErrorFit fitErrors(const std::vector<KnownLook>& looks, const std::vector<Opportunity>& labelled,
                   double gate);
/// The same by labels that know bias and lag better each time: those without draw bearings to the
/// wrong one of two neighbours. σ is of the first, widest labels, which cut none of it off.
/// `labelling` is left with what was found.
ErrorFit fitErrors(const std::vector<KnownLook>& looks,
                   const std::vector<Eigen::Vector2d>& targets_map, LabellingConfig& labelling);
/// Variance of the mean of many errors of a target over that of independent ones, 1 + 2 Σ ρ_k, by
/// the correlation of errors k detections apart up to where it is lost; looks are those of one
/// robot.
double inflationOf(const std::vector<KnownLook>& looks, const std::vector<Opportunity>& labelled,
                   const ErrorFit& fit);

}  // namespace sightline::targets
