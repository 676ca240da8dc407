#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <tf2/buffer_core.h>

#include "sightline/bridge/target_output.h"
#include "sightline/bridge/tf_transforms.h"
#include "sightline/bridge/transform_input.h"
#include "sightline/targets/target_log.h"

namespace sightline::bridge {

/// Runs the target tracker over recordings of bearings and poses, and writes `targets` to
/// DIR/out.bag and all estimates to DIR/targets.csv.
class RecordedTargets {
 public:
  /// Throws config::Error where a file is no bag, or a robot has no bearings in them.
  RecordedTargets(const std::vector<std::string>& paths, const pipeline::TargetsConfig& config,
                  const std::string& folder);

  /// Reads all; `progress` is called with the ratio that has been read.
  void read(const std::function<void(double)>& progress);

  std::size_t used() const { return output_.used(); }
  double duration() const { return duration_; }  ///< of the bags [s]
  std::vector<std::string> summary() const;

 private:
  void take(const rosbag::MessageInstance& message);
  void takeLook(const std::string& robot, const BearingArray& message);
  void refuse(const std::string& topic, const std::string& reason);

  pipeline::TargetsConfig config_;
  std::deque<rosbag::Bag> bags_;
  std::map<std::string, std::string> bearings_;  // robot by topic
  std::map<std::string, std::string> poses_;
  tf2::BufferCore buffer_{ros::Duration(30.0)};
  TransformInput transform_input_{buffer_};
  TfTransforms transforms_{buffer_};
  rosbag::Bag out_;
  ros::Time now_;
  Output bag_output_{out_, now_};
  targets::TargetLogWriter log_;
  TargetOutput output_;
  std::map<std::string, std::size_t> refused_;
  double duration_ = 0.0;
};

}  // namespace sightline::bridge
