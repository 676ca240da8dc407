#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sightline/geometry/stamped_pose2.h"
#include "sightline/pipeline/bearing_topics.h"
#include "sightline/pipeline/transforms.h"
#include "sightline/targets/bearing_set.h"

namespace sightline::pipeline {

/// A look without its pose.
struct ArrivedLook {
  std::string robot;
  std::string frame;
  targets::BearingSet set;
  std::int64_t arrival = 0;  ///< [ns]
};

/// Gives looks the pose of their sensor at their stamp, which may come after them.
class BearingFeed {
 public:
  /// `transforms` are asked where the settings name no topic of poses; they have to live as long.
  BearingFeed(const BearingTopics& topics, const Transforms& transforms);

  /// Pose of a robot's sensor in the map at a time [ns].
  void addPose(const std::string& robot, std::int64_t stamp, const geometry::UncertainPose2& pose);
  void add(ArrivedLook look);

  struct Ready {
    std::string robot;
    targets::BearingSet set;
    std::string fault;  ///< empty, or why it has no pose
  };
  /// Looks that have got their pose, in the order of their stamps, and those that have waited too
  /// long, at a time [ns].
  std::vector<Ready> ready(std::int64_t now);
  /// Looks that are waiting.
  std::size_t waiting() const { return looks_.size(); }
  void clear();

 private:
  struct Poses {
    std::deque<geometry::StampedPose2> history;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // newest
  };
  std::optional<geometry::UncertainPose2> poseOf(const ArrivedLook& look, std::int64_t stamp) const;
  double turnRateOf(const ArrivedLook& look, const geometry::Pose2& pose) const;

  BearingTopics topics_;
  const Transforms& transforms_;
  std::map<std::string, Poses> poses_;
  std::map<std::string, std::string> frames_;  // of each robot's sensor
  std::deque<ArrivedLook> looks_;
};

}  // namespace sightline::pipeline
