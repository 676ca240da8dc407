#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>
#include <sightline/BearingArray.h>
#include <tf2/buffer_core.h>

#include "sightline/bridge/tf_transforms.h"
#include "sightline/bridge/transform_input.h"
#include "sightline/pipeline/bearing_feed.h"

namespace sightline::bridge {

/// Recordings of bearings and poses of a team, read as one in the order of their time.
class BearingBags {
 public:
  /// Throws config::Error where a file is no bag, or a robot has no bearings in them.
  BearingBags(const std::vector<std::string>& paths, const pipeline::BearingTopics& team);

  /// What feeds ask that take poses from transforms.
  const pipeline::Transforms& transforms() const { return transforms_; }
  /// Hands every look and pose to the feed; `after` is called after each message with the time of
  /// the bags, and once more in the end, when what still waits has waited long enough.
  using After = std::function<void(const ros::Time& now, double ratio)>;
  void read(pipeline::BearingFeed& feed, const After& after);

  double duration() const { return duration_; }  ///< [s]
  /// Messages that were left out, by topic and reason.
  const std::map<std::string, std::size_t>& refused() const { return refused_; }

 private:
  void take(const rosbag::MessageInstance& message, pipeline::BearingFeed& feed);
  void takeTransforms(const rosbag::MessageInstance& message, bool is_static);

  pipeline::BearingTopics team_;
  std::deque<rosbag::Bag> bags_;
  std::map<std::string, std::string> bearings_;  // robot by topic
  std::map<std::string, std::string> poses_;
  tf2::BufferCore buffer_{ros::Duration(30.0)};
  TransformInput transform_input_{buffer_};
  TfTransforms transforms_{buffer_};
  std::map<std::string, std::size_t> refused_;
  double duration_ = 0.0;
};

}  // namespace sightline::bridge
