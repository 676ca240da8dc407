#include "sightline/bridge/transform_input.h"

#include <fmt/format.h>

#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"

namespace sightline::bridge {

namespace {

std::string faultOf(const geometry_msgs::TransformStamped& transform) {
  if (transform.child_frame_id.empty() || transform.header.frame_id.empty()) {
    return "a frame without a name";
  }
  if (transform.child_frame_id == transform.header.frame_id) return "a frame in itself";
  const auto& t = transform.transform.translation;
  return faultOfPose({t.x, t.y, t.z}, transform.transform.rotation);
}

std::string named(const geometry_msgs::TransformStamped& transform, const std::string& fault) {
  return fmt::format("{} to {}: {}", transform.header.frame_id, transform.child_frame_id, fault);
}

}  // namespace

std::vector<std::string> TransformInput::take(const tf2_msgs::TFMessage& message, bool is_static,
                                              std::int64_t now) {
  std::vector<std::string> faults;
  for (const auto& transform : message.transforms) {
    std::string fault = take(transform, is_static, now);
    if (!fault.empty()) faults.push_back(std::move(fault));
  }
  return faults;
}

std::string TransformInput::take(geometry_msgs::TransformStamped transform, bool is_static,
                                 std::int64_t now) {
  transform.header.frame_id = withoutSlash(transform.header.frame_id);
  transform.child_frame_id = withoutSlash(transform.child_frame_id);
  std::string fault = faultOf(transform);
  if (fault.empty() && !is_static) fault = judge(transform, now);
  if (!fault.empty()) return named(transform, fault);
  const std::int64_t stamp = nanoseconds(transform.header.stamp);
  Child& child = children_[transform.child_frame_id];
  // Some repeat what they said before; tf itself would complain each time.
  if (!is_static && stamp == child.newest) return "";
  child.newest = stamp;
  transform.transform.rotation = normalized(transform.transform.rotation);
  buffer_.setTransform(transform, "sightline", is_static);
  return "";
}

std::string TransformInput::judge(const geometry_msgs::TransformStamped& transform,
                                  std::int64_t now) {
  const std::int64_t stamp = nanoseconds(transform.header.stamp);
  std::string fault = pipeline::faultOfStamp(stamp);
  if (!fault.empty()) return fault;
  pipeline::StampWatch& stamps = children_[transform.child_frame_id].stamps;
  const double leap = stamps.leap(stamp);
  switch (stamps.judge(stamp, now)) {
    case pipeline::StampWatch::Verdict::kGood:
      return "";
    case pipeline::StampWatch::Verdict::kStray:
      return pipeline::describeLeap(leap);
    case pipeline::StampWatch::Verdict::kClockSet:
      break;
  }
  if (leap < 0.0) buffer_.clear();
  return "";
}

}  // namespace sightline::bridge
