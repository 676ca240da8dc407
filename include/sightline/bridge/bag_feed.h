#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>
#include <rosbag/view.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include "sightline/bridge/feed_input.h"
#include "sightline/bridge/tf_transforms.h"
#include "sightline/bridge/transform_input.h"
#include "sightline/pipeline/estimators_config.h"

namespace sightline::bridge {

/// Static transforms of the mountings of the scanners on the base.
tf2_msgs::TFMessage mountingTransforms(const pipeline::EstimatorsConfig& config);

/// Opens a bag to read it. Throws config::Error that says which file is at fault, and what helps.
void openToRead(rosbag::Bag& bag, const std::string& path);

/// A feed over recordings, read as one in the order of their time, with little memory however long
/// they are. Its clock is the time of the bags. Topics are found with and without a leading slash.
class BagFeed {
 public:
  struct Visitor {
    /// Each located scan; `now` is how far the bags have been read.
    std::function<void(pipeline::LocatedScan, const ros::Time& now)> scan;
    /// Each message of a scan or a transform as it stands in the bag.
    std::function<void(const rosbag::MessageInstance&)> message;
    /// Called after each message with the ratio of the bags' time that has been read, 0 to 1.
    std::function<void(double)> progress;
  };

  /// Throws config::Error where a file is no whole bag or there are none of a topic's scans.
  BagFeed(const std::vector<std::string>& paths, const pipeline::EstimatorsConfig& config,
          const pipeline::FeedNeeds& needs);

  /// Reads a damaged bag as far as it goes; see damage().
  void read(const Visitor& visitor);
  /// The damage that ended the reading; empty where all was read.
  const std::string& damage() const { return damage_; }

  /// Messages on the topics of the scans.
  std::size_t scans() const;
  /// Number of them that could not be used, by reason.
  std::map<std::string, std::size_t> dropped() const;
  /// Number of readings of transforms, odometry and inertial sensor that could not be used, by
  /// reason.
  const std::map<std::string, std::size_t>& refused() const { return refused_; }
  std::size_t withoutMotion() const;
  /// Breaks in the odometry that were bridged.
  std::size_t breaks() const;
  /// Times that the clock was set.
  std::size_t restarts() const { return restarts_; }
  /// What turns show to be wrong with scanners' beams and times, one text a scanner.
  std::vector<std::string> faultsOfTurns() const;
  /// Faults that were mended in scans, each once.
  std::vector<std::string> mended() const;
  /// Time from the first scan to the last [s].
  double duration() const { return (last_scan_ - first_scan_).toSec(); }

 private:
  void open(const std::string& path);
  void addScanner(const std::string& topic);
  void takeStaticTransforms();
  void readAll(const Visitor& visitor);
  void take(const rosbag::MessageInstance& instance);
  void takeScan(std::size_t scanner, const rosbag::MessageInstance& instance);
  void takeTransforms(const tf2_msgs::TFMessage& message, const std::string& topic,
                      std::int64_t now);
  void takeReading(const rosbag::MessageInstance& instance);
  void deliver(const ros::Time& now, bool at_end, const Visitor& visitor);

  std::deque<rosbag::Bag> bags_;
  std::string paths_;  // for messages
  tf2::BufferCore buffer_;
  TransformInput transform_input_{buffer_};
  TfTransforms transforms_{buffer_};
  pipeline::ScanFeed feed_;
  FeedInput input_;
  std::map<std::string, std::size_t> scanners_;  // by topic without its slash
  std::vector<std::string> readings_;            // topics of odometry and imu, likewise
  std::map<std::string, std::size_t> refused_;
  std::string damage_;
  std::size_t restarts_ = 0;
  ros::Time first_scan_;
  ros::Time last_scan_;
  ros::Time last_;  // time of the last message
};

}  // namespace sightline::bridge
