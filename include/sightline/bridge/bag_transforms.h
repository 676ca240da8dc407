#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include "sightline/bridge/pose_conversion.h"

namespace sightline::bridge {

/// The transforms of a bag around the message that is being read, without a listener or a clock.
class BagTransforms {
 public:
  void add(const tf2_msgs::TFMessage& message, bool is_static);

  /// Pose of frame `source` in frame `target` at a time [ns]; nothing where the transforms read so
  /// far do not reach it.
  std::optional<geometry_msgs::Transform> at(const std::string& target, const std::string& source,
                                             std::int64_t stamp) const;

 private:
  tf2::BufferCore buffer_;
};

}  // namespace sightline::bridge
