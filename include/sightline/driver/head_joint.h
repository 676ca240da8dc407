#pragma once

#include <string>

#include <Eigen/Core>

#include "sightline/triangulation/head_command.h"

namespace sightline::driver {

/// The joint of the sensor head, and where the scan sits on what it turns, from a robot
/// description.
struct HeadJoint {
  std::string name;
  /// Lower and upper end, and the largest rate; the rest is as for any servo of this sensor.
  triangulation::HeadLimits limits;
  /// Of the projection frame in the head's [m].
  Eigen::Vector2d scan_origin = Eigen::Vector2d::Zero();

  /// `joint` names the head's, a revolute one about z; `projection_frame` the link that hangs on
  /// the head by a fixed joint, parallel to it. `source` is for messages: a file or parameter.
  /// Throws config::Error with the joint or link that is missing or does not fit.
  static HeadJoint fromUrdf(const std::string& xml, const std::string& joint,
                            const std::string& projection_frame, const std::string& source);
};

}  // namespace sightline::driver
