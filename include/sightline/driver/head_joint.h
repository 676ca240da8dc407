#pragma once

#include <string>

#include <Eigen/Core>

#include "sightline/config/fields.h"
#include "sightline/motion/head_command.h"

namespace sightline::driver {

/// The joint of the sensor head and the frames about it, by their names in a robot description and
/// in tf.
struct HeadFrames {
  std::string joint = "head_joint";
  std::string mount = "active_sensor";    ///< the head turns about its z axis
  std::string head = "head";              ///< the same frame, turned
  std::string projection = "projection";  ///< hangs on the head by a fixed joint, parallel to it

  void visit(config::FieldVisitor& visitor);
};

/// Joint and frames of a head as a robot description has them.
struct HeadJoint {
  /// Lower and upper end, and the largest rate; the rest is as for any servo of this sensor.
  motion::HeadLimits limits;
  /// Position of the projection frame in the head's [m].
  Eigen::Vector2d scan_origin = Eigen::Vector2d::Zero();
  double scan_height = 0.0;  ///< of the projection frame above the head's [m]

  std::string projection;  ///< name of that frame

  /// `source` is for messages: a file or parameter. Throws config::Error with the joint or link
  /// that is missing or does not fit.
  static HeadJoint fromUrdf(const std::string& xml, const HeadFrames& frames,
                            const std::string& source);
  static HeadJoint readFile(const std::string& path, const HeadFrames& frames);

  /// Throws config::Error naming `source` where the scan's origin is more than a millimetre from
  /// `expected` [m].
  void requireScanOrigin(const Eigen::Vector2d& expected, const std::string& source) const;
};

}  // namespace sightline::driver
