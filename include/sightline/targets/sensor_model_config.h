#pragma once

#include <optional>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/geometry/angle.h"

namespace sightline::targets {

/// Bearings at which a sensor sees, both ends included [rad], |·| ≤ π.
struct FieldOfView {
  double min = -0.75 * geometry::kPi;
  double max = 0.75 * geometry::kPi;

  bool contains(double bearing) const { return bearing >= min && bearing <= max; }
  double width() const { return max - min; }
  /// What both see; empty (min > max) where that is nothing.
  FieldOfView within(const FieldOfView& other) const;
  void visit(config::FieldVisitor& visitor);
};

/// Probability of detection by range and bearing, constant in each bin, in place of the formula of
/// dames eq. 1; none outside of its edges.
struct DetectionTable {
  std::vector<double> range_edges;    ///< rising [m]
  std::vector<double> bearing_edges;  ///< rising [rad]
  std::vector<double> probabilities;  ///< one a bin, ranges outside, bearings inside

  double at(double range, double bearing) const;
  void visit(config::FieldVisitor& visitor);
};

/// Detection model, dames eq. 1.
struct DetectionConfig {
  double false_negative = 0.21;                  ///< p_fn
  double target_diameter = 0.032512;             ///< d_t, 1.28 in [m]
  double beam_spacing = geometry::radians(1.0);  ///< θ_sep [rad]
  double range_min = 0.0;                        ///< [m]
  double range_max = 5.0;                        ///< r_max [m]
  std::optional<DetectionTable> table;

  void visit(config::FieldVisitor& visitor);
};

/// Correlation of the detections of one target by one robot from look to look: for a while a target
/// is one that the robot can see, or one that it cannot (a bump, a blind side, somebody between).
struct VisibilityConfig {
  double share = 1.0;  ///< of the time in which a target can be seen, (0, 1]; 1: independent looks
  double duration = 5.0;  ///< time in which it is forgotten which of both [s]

  void visit(config::FieldVisitor& visitor);
};

/// Error that a sensor makes at one bearing again and again, such as that of a lens: by bearing,
/// linear between those given, constant beyond them.
struct DistortionConfig {
  std::vector<double> bearings;  ///< true ones, rising [rad]
  std::vector<double> errors;    ///< measured less true bearing, one each, besides the bias [rad]

  double at(double bearing) const;
  void visit(config::FieldVisitor& visitor);
};

/// Measurement model, dames eq. 2.
struct BearingConfig {
  double sigma = geometry::radians(2.25);      ///< standard deviation [rad]
  double bias = 0.0;                           ///< measured less true bearing [rad]
  std::optional<DistortionConfig> distortion;  ///< what the bias is more or less by bearing
  double lag = 0.0;  ///< time that looks are stamped late, by which they err as the robot turns [s]
  double jitter =
      0.0;  ///< standard deviation of that time: how much bearings err more in turns [s]
  /// Standard deviation of all errors over σ: filters add a Gaussian 2.5 times as wide, for tails.
  double tail = 1.0;
  /// Share of the variance that the bearings of one look have in common, as of a heading that is
  /// off or a late stamp in a turn [0, 1].
  double common_share = 0.0;
  /// Share of the variance that lasts over a robot's looks, part of what these have in common
  /// [0, 1), and the time constant after which it is forgotten [s].
  double lasting_share = 0.0;
  double lasting_duration = 10.0;
  /// Standard deviation, in x and in y, of where a target is from where all bearings see it [m].
  double place_sigma = 0.0;

  /// Measured less true bearing of a sensor at rest [rad].
  double biasAt(double bearing) const {
    return bias + (distortion ? distortion->at(bearing) : 0.0);
  }
  /// The true bearing that is measured as this one at rest [rad].
  double trueBearing(double measured) const;
  void visit(config::FieldVisitor& visitor);
};

/// Clutter model, dames eq. 3: Poisson in number.
struct ClutterConfig {
  double mean = 0.5319;                     ///< μ, clutter measurements a look
  double uniform_share = 0.725;             ///< p_u
  double peak_width = 0.2 * geometry::kPi;  ///< θ_c, of the peaks at ±π/2 [rad]
  /// Share of the clutter that comes of surfaces that shine towards one side, again and again from
  /// one place [0, 1]; the rest is of looks apart.
  double glint_share = 0.0;
  double glint_width = geometry::radians(2.5);  ///< standard deviation of that side [rad]
  /// Share of the clutter that comes of things seen again and again from all sides, but seldom
  /// [0, 1].
  double faint_share = 0.0;
  /// Probability that one is seen over that of a target, at any range; taken from near by, where
  /// both are most alike.
  double faint_detection = 0.3;

  void visit(config::FieldVisitor& visitor);
};

/// Models of one bearing-only sensor, as YAML that characterize_bearing_sensor writes and
/// simulation and filter read. Defaults are the values of the paper, with the beam spacing of 1° by
/// which they are determined.
struct SensorModelConfig {
  FieldOfView field_of_view;
  DetectionConfig detection;
  VisibilityConfig visibility;
  BearingConfig bearing;
  ClutterConfig clutter;

  void visit(config::FieldVisitor& visitor);
  /// Throws config::Error naming `source` where a value is out of range, or where a density does
  /// not integrate to what it must: peaks of clutter beyond the field of view, a table that is
  /// none.
  void check(const std::string& source = "") const;
  static SensorModelConfig readFile(const std::string& path);
};

}  // namespace sightline::targets
