#include "sightline/bridge/transform_input.h"

#include <utility>

#include <fmt/format.h>

#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"

namespace sightline::bridge {

namespace {

constexpr const char* kAuthority = "sightline";

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
  Faults faults;
  for (Transform transform : message.transforms) {
    transform.header.frame_id = withoutSlash(transform.header.frame_id);
    transform.child_frame_id = withoutSlash(transform.child_frame_id);
    const std::string fault = faultOf(transform);
    if (!fault.empty()) {
      faults.push_back(named(transform, fault));
      continue;
    }
    transform.transform.rotation = normalized(transform.transform.rotation);
    if (is_static) {
      buffer_.setTransform(transform, kAuthority, is_static);
    } else {
      admit(transform, now, faults);
    }
  }
  return faults;
}

void TransformInput::admit(const Transform& transform, std::int64_t now, Faults& faults) {
  const std::int64_t stamp = nanoseconds(transform.header.stamp);
  const std::string fault = pipeline::faultOfStamp(stamp);
  if (!fault.empty()) return faults.push_back(named(transform, fault));
  Child& child = children_[transform.child_frame_id];
  const double leap = child.stamps.leap(stamp);
  switch (child.stamps.judge(stamp, now)) {
    case pipeline::StampWatch::Verdict::kGood:
      dropStrays(child, faults);
      break;
    case pipeline::StampWatch::Verdict::kStray:
      if (child.stamps.strays() == 1) dropStrays(child, faults);
      child.strays.push_back(transform);
      return;
    case pipeline::StampWatch::Verdict::kClockSet:
      beginNewTime(child, leap < 0.0);
      break;
  }
  insert(transform, child);
}

// What is from the future of the new time would keep the buffer from taking anything.
void TransformInput::beginNewTime(Child& child, bool is_earlier) {
  if (is_earlier) buffer_.clear();
  child.newest = 0;
  for (const Transform& stray : std::exchange(child.strays, {})) insert(stray, child);
}

void TransformInput::dropStrays(Child& child, Faults& faults) {
  for (const Transform& stray : std::exchange(child.strays, {})) {
    const double leap = child.stamps.leap(nanoseconds(stray.header.stamp));
    faults.push_back(named(stray, pipeline::describeLeap(leap)));
  }
}

// Some repeat what they said before; tf itself would complain each time.
void TransformInput::insert(const Transform& transform, Child& child) {
  const std::int64_t stamp = nanoseconds(transform.header.stamp);
  if (stamp == child.newest) return;
  child.newest = stamp;
  buffer_.setTransform(transform, kAuthority, /*is_static=*/false);
}

}  // namespace sightline::bridge
