#include "sightline/bridge/frames_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/tf_transforms.h"
#include "sightline/bridge/time.h"

namespace sightline::bridge {

namespace {

// Names that bases have where the one of the settings is not there.
constexpr std::array<const char*, 4> kBases{"base_footprint", "base_link", "base", "robot_base"};
const ros::Duration kWholeRecording(1e6);

}  // namespace

FramesCheck::FramesCheck(const pipeline::Frames& frames)
    : frames_(frames), buffer_(kWholeRecording) {}

void FramesCheck::take(const tf2_msgs::TFMessage& message, bool is_static) {
  for (const auto& transform : message.transforms) takeTransform(transform, is_static);
}

void FramesCheck::takeTransform(geometry_msgs::TransformStamped transform, bool is_static) {
  const std::string parent = withoutSlash(transform.header.frame_id);
  const std::string child = withoutSlash(transform.child_frame_id);
  with_slash_ += parent != transform.header.frame_id || child != transform.child_frame_id;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  Link& link = links_[child];
  const std::int64_t stamp = nanoseconds(transform.header.stamp);
  link.repeated += link.messages > 0 && !is_static && stamp == link.stamp;
  link.parents.insert(parent);
  link.is_static = is_static;
  link.stamp = stamp;
  ++link.messages;
  const auto& t = transform.transform.translation;
  const std::string fault = faultOfPose({t.x, t.y, t.z}, transform.transform.rotation);
  if (!fault.empty()) return void(++refused_[fmt::format("{} to {}: {}", parent, child, fault)]);
  if (!is_static) takeOdometry(transform);
  buffer_.setTransform(transform, "recording", is_static);
}

void FramesCheck::takeOdometry(const geometry_msgs::TransformStamped& transform) {
  const bool is_named = transform.header.frame_id == frames_.odom;
  if (!is_named && transform.child_frame_id != frames_.base) return;
  OdometryCheck& check = is_named ? odometry_ : of_base_;
  check.add(nanoseconds(transform.header.stamp), toPose2(transform.transform));
}

const OdometryCheck& FramesCheck::odometry() const {
  return odometry_.poses().empty() ? of_base_ : odometry_;
}

bool FramesCheck::isKnown(const std::string& frame) const {
  const auto has_parent = [&](const auto& link) { return link.second.parents.count(frame) > 0; };
  return links_.count(frame) > 0 || std::any_of(links_.begin(), links_.end(), has_parent);
}

std::string FramesCheck::base() const {
  if (isKnown(frames_.base)) return frames_.base;
  for (const char* name : kBases) {
    if (isKnown(name)) return name;
  }
  return frames_.base;
}

std::string FramesCheck::odom() const {
  if (isKnown(frames_.odom)) return frames_.odom;
  const auto link = links_.find(base());
  return link == links_.end() || link->second.is_static ? frames_.odom
                                                        : *link->second.parents.begin();
}

std::optional<Mounting> FramesCheck::mounting(const std::string& frame, std::int64_t stamp) const {
  const auto T_base_sensor = TfTransforms(buffer_).at(base(), withoutSlash(frame), stamp);
  if (!T_base_sensor) return std::nullopt;
  const Eigen::Matrix3d R = T_base_sensor->rotation();
  Mounting mounting;
  mounting.upside_down = R(2, 2) < 0.0;
  mounting.T_base_sensor = {T_base_sensor->translation().head<2>(), std::atan2(R(1, 0), R(0, 0))};
  return mounting;
}

std::vector<std::string> FramesCheck::tree() const {
  std::vector<std::string> lines;
  for (const auto& [child, link] : links_) {
    lines.push_back(fmt::format(
        "{} -> {}, {}", fmt::join(link.parents, " and "), child,
        link.is_static ? std::string("static") : fmt::format("{} times", link.messages)));
  }
  return lines;
}

Findings FramesCheck::findings() const {
  Findings findings;
  const auto add = [&](Severity severity, std::string text) {
    findings.push_back({severity, std::move(text)});
  };
  for (const auto& [child, link] : links_) {
    if (link.parents.size() > 1) {
      add(Severity::kError, fmt::format("frame {} has several parents: {}; one of them has to go",
                                        child, fmt::join(link.parents, ", ")));
    }
    if (10 * link.repeated > link.messages) {
      add(Severity::kWarning, fmt::format("{} of {} transforms to {} repeat a stamp: two nodes may "
                                          "send them",
                                          link.repeated, link.messages, child));
    }
  }
  for (const auto& [reason, count] : refused_) {
    add(Severity::kError, fmt::format("{} transforms left out, {}", count, reason));
  }
  if (with_slash_ > 0) {
    add(Severity::kNote, "frames are written with a leading slash, which is left away");
  }
  return findings;
}

}  // namespace sightline::bridge
