#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>
#include <sensor_msgs/LaserScan.h>

#include "sightline/bridge/bag_transforms.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/pipeline/offline_config.h"

namespace sightline::bridge {

/// A scan with what the transforms of its bag say of it.
struct LocatedScan {
  scan::Scan scan;  ///< with the motion within the sweep, where the odometry knows it
  std::optional<geometry::Pose2> T_base_sensor;
  std::optional<geometry::Pose2> T_odom_base;  ///< at the stamp
};

/// Reads the scans of a bag in order, with little memory however long it is.
///
/// As in a running graph, a scan waits until the transforms cover its sweep, and goes on without
/// what is still missing a second later.
class BagScans {
 public:
  struct Visitor {
    /// Each scan that can be read; `now` is how far the bag has been read.
    std::function<void(const LocatedScan&, const ros::Time& now)> scan;
    /// Each message of a scan or a transform as it stands in the bag.
    std::function<void(const rosbag::MessageInstance&)> message;
    /// After each message, the share of the bag's time that has been read, 0 to 1.
    std::function<void(double)> progress;
  };

  /// `use_wheels`: whether the odometry is asked at all. Throws config::Error where the file is no
  /// whole bag or holds none of a topic's scans.
  BagScans(const std::string& path, const pipeline::OfflineConfig& config, bool use_wheels);

  /// Throws config::Error where the bag is damaged.
  void read(const Visitor& visitor);

  /// Messages on the topics of the scans.
  std::size_t scans() const { return scans_; }
  /// How many of them could not be read, by reason.
  const std::map<std::string, std::size_t>& dropped() const { return dropped_; }
  /// From the first to the last scan [s].
  double duration() const { return (last_scan_ - first_scan_).toSec(); }

 private:
  struct Waiting {
    ScanReader* reader;
    sensor_msgs::LaserScanConstPtr message;
    ros::Time arrival;
    LocatedScan located;
    bool was_read = false;
  };

  template <class Call>
  void withPath(const Call& call) const;
  void checkTopics();
  void readAll(const Visitor& visitor);
  void take(const rosbag::MessageInstance& instance, const Visitor& visitor);
  void takeScan(const rosbag::MessageInstance& instance, ScanReader& reader);
  void releaseWaiting(const ros::Time& now, bool at_end, const Visitor& visitor);
  bool complete(Waiting& waiting, bool is_late);
  void addMotion(LocatedScan& located);

  std::string path_;
  rosbag::Bag bag_;
  pipeline::Frames frames_;
  bool use_wheels_;
  BagTransforms transforms_;
  std::map<std::string, ScanReader> readers_;  // by topic
  std::deque<Waiting> waiting_;
  std::size_t scans_ = 0;
  std::map<std::string, std::size_t> dropped_;
  ros::Time first_scan_;
  ros::Time last_scan_;
};

}  // namespace sightline::bridge
