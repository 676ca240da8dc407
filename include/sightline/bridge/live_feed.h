#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <tf2/buffer_core.h>

#include "sightline/bridge/awaited_text.h"
#include "sightline/bridge/feed_input.h"
#include "sightline/bridge/input_monitor.h"
#include "sightline/bridge/tf_transforms.h"
#include "sightline/bridge/transform_input.h"
#include "sightline/pipeline/estimators_config.h"

namespace sightline::bridge {

/// A located scan that could not be used all the same. what() names the reason.
class UnusedScan : public std::runtime_error {
 public:
  UnusedScan(const std::string& reason, bool blameless)
      : std::runtime_error(reason), is_blameless(blameless) {}
  bool is_blameless;  ///< while a graph starts, some come too early
};

/// A feed over the topics of a running graph. Its clock goes on evenly whatever happens to the
/// system's.
class LiveFeed {
 public:
  /// Gets each located scan. It may throw UnusedScan or scan::InvalidScan, which are counted and
  /// told.
  using Consumer = std::function<void(pipeline::LocatedScan)>;

  /// The updater has to live as long. Throws config::Error.
  LiveFeed(ros::NodeHandle node, const pipeline::InputConfig& config,
           const pipeline::Frames& frames, const pipeline::FeedNeeds& needs,
           diagnostic_updater::Updater& updater, Consumer consumer);

  const pipeline::FeedCounts& counts(std::size_t scanner) const { return feed_.counts(scanner); }
  std::size_t scanners() const { return feed_.scanners(); }
  /// Name of a scanner's topic, as it was given.
  const std::string& topic(std::size_t scanner) const { return topics_[scanner]; }

 private:
  struct Input {
    ros::Subscriber subscriber;
    std::unique_ptr<InputMonitor> monitor;  // of odometry and imu: from the first message on
  };

  template <class Message>
  void addScanner(ros::NodeHandle& node, const std::string& topic);
  template <class Message>
  void subscribe(ros::NodeHandle& node, const std::string& topic, Input& input);
  void subscribeTransforms(ros::NodeHandle& node, const std::string& topic, Input& input);
  template <class Message>
  void onScan(std::size_t scanner, const Message& message);
  std::string awaited() const;
  void deliver();
  void deliver(pipeline::FeedResult& result);

  diagnostic_updater::Updater& updater_;
  Consumer consumer_;
  tf2::BufferCore buffer_;
  TransformInput transform_input_{buffer_};
  TfTransforms transforms_{buffer_};
  pipeline::ScanFeed feed_;
  FeedInput input_;
  std::vector<std::string> topics_;
  std::vector<Input> scanners_;
  Input tf_;
  Input tf_static_;
  Input odometry_;
  Input imu_;
  ros::SteadyTimer timer_;
  AwaitedText awaited_text_;
};

}  // namespace sightline::bridge
