#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"

namespace sightline::motion {

/// Rotation of a head during a sweep.
struct HeadSweep {
  std::vector<double> angles;  ///< of the head's joint [rad], one a beam
  std::string mount_frame;     ///< in which the head turns, its axes there at an angle of 0
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< of the projection frame in the head's [m]

  /// Pose of the projection frame in the mount's at a beam.
  geometry::Pose2 T_mount_sensor(std::size_t beam) const;
};

/// A scan whose sensor turned with its head.
struct RangeScan {
  /// Scan in the projection frame at the first beam; the sensor's motion is that of the head alone.
  scan::Scan scan;
  HeadSweep head;
};

/// Pose of the projection frame at each beam, in that of the first one, while the head turns about
/// its axis (pears eqs 15-20 are what this does to a line). Empty where nothing moved.
///
/// @param mount_motion  pose at each beam of what the head turns on, in its own frame at the first
///                      beam; empty where that stood still
std::vector<geometry::Pose2> headMotion(const HeadSweep& head,
                                        const std::vector<geometry::Pose2>& mount_motion = {});

/// The sweep of a head that hangs upside down as one the right way up sees it: angles and origin
/// mirrored at the x axis.
HeadSweep mirrored(HeadSweep head);

}  // namespace sightline::motion
