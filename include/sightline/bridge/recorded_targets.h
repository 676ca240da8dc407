#pragma once

#include <functional>
#include <string>
#include <vector>

#include <rosbag/bag.h>

#include "sightline/bridge/bearing_bags.h"
#include "sightline/bridge/target_output.h"
#include "sightline/targets/target_log.h"

namespace sightline::bridge {

/// Runs the target tracker over recordings of bearings and poses, and writes `targets` to
/// DIR/out.bag and all estimates to DIR/targets.csv.
class RecordedTargets {
 public:
  /// Throws config::Error.
  RecordedTargets(const std::vector<std::string>& paths, const pipeline::TargetsConfig& config,
                  const std::string& folder);

  /// Reads all; `progress` is called with the ratio that has been read.
  void read(const std::function<void(double)>& progress);

  std::size_t used() const { return output_.used(); }
  double duration() const { return bags_.duration(); }  ///< of the bags [s]
  std::vector<std::string> summary() const;

 private:
  BearingBags bags_;
  rosbag::Bag out_;
  ros::Time now_;
  Output bag_output_{out_, now_};
  targets::TargetLogWriter log_;
  TargetOutput output_;
};

}  // namespace sightline::bridge
