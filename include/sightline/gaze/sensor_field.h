#pragma once

#include <Eigen/Core>

#include "sightline/config/fields.h"
#include "sightline/geometry/angle.h"
#include "sightline/geometry/pose2.h"

namespace sightline::gaze {

/// Field of view of a sensor that turns with a head about the z axis of its mount. Defaults are
/// those of the sensor of pears (table 1).
struct SensorField {
  double half_width = geometry::radians(20.0);  ///< [rad]
  double centre = 0.0;     ///< direction of the middle of the field in the head's frame [rad]
  double range_min = 0.4;  ///< [m]
  double range_max = 2.5;  ///< [m]
  double origin_x = 0.05;  ///< of the beams, in the head's frame [m]
  double origin_y = -0.03;
  int beams = 256;
  /// Standard deviation of a range at 1 m [m], and the power of the range that it grows with: 4.1
  /// fits pears table 2, 0 is a time-of-flight scanner's.
  double range_sigma = 0.0015;
  double range_exponent = 4.1;

  void visit(config::FieldVisitor& visitor);

  Eigen::Vector2d origin() const { return {origin_x, origin_y}; }
  double sigmaAt(double range) const;  ///< [m]
  /// Pose of the sensor in its mount, its x axis through the middle of the field.
  geometry::Pose2 T_mount_sensor(double head_angle) const;
  /// Head angle at which a place in the mount's frame lies in the middle of the field; that of its
  /// direction where it is nearer to the axis than the beams' origin [rad].
  double aimAt(const Eigen::Vector2d& place_mount) const;
  /// Whether a place in the mount's frame is in the field and in reach at a head angle.
  bool holds(const Eigen::Vector2d& place_mount, double head_angle) const;
};

}  // namespace sightline::gaze
