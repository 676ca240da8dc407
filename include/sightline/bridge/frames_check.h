#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include "sightline/bridge/finding.h"
#include "sightline/bridge/odometry_check.h"
#include "sightline/geometry/pose2.h"
#include "sightline/pipeline/feed_config.h"

namespace sightline::bridge {

/// How a scanner sits on the base.
struct Mounting {
  geometry::Pose2 T_base_sensor;
  bool upside_down = false;
};

/// Gathers the transforms of a recording and what they reach.
class FramesCheck {
 public:
  explicit FramesCheck(const pipeline::Frames& frames);

  void take(const tf2_msgs::TFMessage& message, bool is_static);

  /// Frames by the settings, or those that the recording has in their place.
  std::string base() const;
  std::string odom() const;
  /// Poses in odom as they were sent, or of the base in its parent where there is no odom.
  const OdometryCheck& odometry() const;
  /// Mounting of a frame at a stamp [ns]; nothing where the transforms do not reach it.
  std::optional<Mounting> mounting(const std::string& frame, std::int64_t stamp) const;
  /// What is wrong with the tree itself.
  Findings findings() const;
  const tf2::BufferCore& transforms() const { return buffer_; }
  /// Every frame with its parent, one a line.
  std::vector<std::string> tree() const;

 private:
  struct Link {
    std::set<std::string> parents;
    bool is_static = false;
    std::size_t messages = 0;
    std::size_t repeated = 0;  // with the stamp of the one before
    std::int64_t stamp = 0;
  };
  void takeTransform(geometry_msgs::TransformStamped transform, bool is_static);
  void takeOdometry(const geometry_msgs::TransformStamped& transform);
  bool isKnown(const std::string& frame) const;

  pipeline::Frames frames_;
  tf2::BufferCore buffer_;
  std::map<std::string, Link> links_;  // by child
  std::size_t with_slash_ = 0;
  std::map<std::string, std::size_t> refused_;  // transforms that are none, by reason
  OdometryCheck odometry_;
  OdometryCheck of_base_;
};

}  // namespace sightline::bridge
