#pragma once

#include <string>

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "sightline/scan/scan.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::bridge {

/// How a scanner moved during its sweeps, from tf.
///
/// A scan is never held back for it: where tf does not reach the end of the sweep yet, the newest
/// stretch that is as long as the sweep stands for it, unless tf has fallen behind.
class SweepFromTf {
 public:
  /// `fixed_frame` is one in which the world stands still and the sensor moves smoothly.
  explicit SweepFromTf(std::string fixed_frame) : fixed_frame_(std::move(fixed_frame)) {}

  /// Fills in `sensor_motion`. False, and a scan left as it was, where tf cannot tell.
  bool addMotion(scan::Scan& scan) const;
  /// As above, of a sensor whose head turns on something that moves: how the head turned is known
  /// from the scan, which may have accelerated.
  bool addMotion(motion::RangeScan& range_scan) const;

 private:
  std::string fixed_frame_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_{transforms_};
};

}  // namespace sightline::bridge
