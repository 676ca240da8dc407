#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <rosbag/bag.h>

#include "sightline/bridge/bag_scans.h"
#include "sightline/lines/line_extractor.h"
#include "sightline/logs/trajectory.h"
#include "sightline/pipeline/scan_odometry.h"
#include "sightline/tracking/room_tracker.h"

namespace sightline::bridge {

/// An estimator that takes the scans of one bag and writes what it finds to another.
class BagEstimator {
 public:
  virtual ~BagEstimator() = default;
  /// `now` is the time that messages are written with: that of a running graph.
  virtual void process(const LocatedScan& located, const ros::Time& now) = 0;
  /// To be called after the last scan. Throws config::Error if a file could not be written.
  virtual void finish() {}
  /// What has been found, a line of text each.
  virtual std::vector<std::string> summary() const = 0;
};

/// Lines of each scan on /lines.
class BagLines : public BagEstimator {
 public:
  /// The bag has to outlive the estimator. Throws config::Error.
  BagLines(const pipeline::OfflineConfig& config, rosbag::Bag& out);

  void process(const LocatedScan& located, const ros::Time& now) override;
  std::vector<std::string> summary() const override;

 private:
  lines::LineExtractor extractor_;
  rosbag::Bag& out_;
  std::size_t scans_ = 0;
  std::size_t segments_ = 0;
  std::size_t arcs_ = 0;
};

/// The pose in the rooms of a map: /pose, /tracker_status, map→odom on /tf, the map itself,
/// latched, on /map, and the trajectory in a file.
class BagRooms : public BagEstimator {
 public:
  /// The bag has to outlive the estimator. Throws config::Error.
  BagRooms(const pipeline::OfflineConfig& config, rosbag::Bag& out, const std::string& trajectory);

  void process(const LocatedScan& located, const ros::Time& now) override;
  void finish() override { trajectory_.close(); }
  std::vector<std::string> summary() const override;

 private:
  void writeMap(const ros::Time& now);
  void write(const tracking::TrackerUpdate& update, const ros::Time& now);

  pipeline::Frames frames_;
  tracking::RoomTracker tracker_;
  rosbag::Bag& out_;
  logs::TrajectoryWriter trajectory_;
  std::size_t scans_ = 0;
  std::size_t poses_ = 0;
  std::size_t lost_ = 0;
  std::map<std::string, std::size_t> without_pose_;  // by reason
};

/// Odometry from the scans, with the wheels as prior where the bag has them and they may be used:
/// /laser_odom, and the trajectory in a file. A scanner that no transform leads to is taken for the
/// base itself.
class BagOdometry : public BagEstimator {
 public:
  /// The bag has to outlive the estimator. Throws config::Error.
  BagOdometry(const pipeline::OfflineConfig& config, rosbag::Bag& out,
              const std::string& trajectory);

  void process(const LocatedScan& located, const ros::Time& now) override;
  void finish() override { trajectory_.close(); }
  std::vector<std::string> summary() const override;

 private:
  pipeline::Frames frames_;
  pipeline::ScanOdometry odometry_;
  rosbag::Bag& out_;
  logs::TrajectoryWriter trajectory_;
  std::size_t scans_ = 0;
  std::size_t poses_ = 0;
  std::size_t flagged_ = 0;
  std::size_t with_wheels_ = 0;
};

}  // namespace sightline::bridge
