#include "sightline/bridge/sweep_from_tf.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/pipeline/scan_motion.h"

namespace sightline::bridge {

namespace {

// Older than this, the newest motion says nothing about the present one [ns].
constexpr std::int64_t kOldest = 500'000'000;

// In the sensor's own frame and in three dimensions before it is taken to the plane: that holds for
// a sensor mounted on its head as well.
geometry::Pose2 motionBetween(const tf2_ros::Buffer& transforms, const std::string& frame,
                              const ros::Time& from, const ros::Time& to,
                              const std::string& fixed_frame) {
  return toPose2(transforms.lookupTransform(frame, from, frame, to, fixed_frame).transform);
}

}  // namespace

bool SweepFromTf::addMotion(scan::Scan& scan) const {
  const auto poseAt = [&](std::int64_t stamp) -> std::optional<geometry::Pose2> {
    if (stamp == scan.stamp) return geometry::Pose2();
    try {
      const std::int64_t newest = nanoseconds(
          transforms_.lookupTransform(fixed_frame_, scan.frame, ros::Time(0)).header.stamp);
      // A transform that never changes has no time and moves nothing.
      if (newest == 0) return geometry::Pose2();
      if (stamp - newest > kOldest) return std::nullopt;
      const std::int64_t end = std::min(stamp, newest);
      const std::int64_t start = end - (stamp - scan.stamp);
      if (start <= 0) return std::nullopt;
      return motionBetween(transforms_, scan.frame, timeOf(start), timeOf(end), fixed_frame_);
    } catch (const tf2::TransformException&) {
      return std::nullopt;
    }
  };
  return pipeline::addMotion(scan, poseAt, geometry::Pose2()).has_value();
}

bool SweepFromTf::addMotion(motion::RangeScan& range_scan) const {
  scan::Scan mount(range_scan.scan.geometry(), range_scan.scan.stamp, range_scan.scan.ranges());
  mount.frame = range_scan.head.mount_frame;
  if (!addMotion(mount)) return false;
  range_scan.scan.setSensorMotion(motion::headMotion(range_scan.head, mount.sensorMotion()));
  return true;
}

}  // namespace sightline::bridge
