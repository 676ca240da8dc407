#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>

#include <sightline/RangeScan.h>
#include "sightline/bridge/range_scan_conversion.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/pipeline/scan_feed.h"

namespace sightline::bridge {

/// What is said of a scanner whose scans turn against the odometry.
inline constexpr const char* kTurnsOpposite =
    "its scans turn against the odometry: the beams run in the other sense than angle_increment "
    "says, "
    "or the odometry counts turns the wrong way";

/// Puts messages into a feed, live and from a bag alike.
class FeedInput {
 public:
  /// Feed and transforms have to live as long.
  FeedInput(pipeline::ScanFeed& feed, const pipeline::Transforms& transforms,
            std::string base_frame)
      : feed_(feed), transforms_(transforms), base_frame_(std::move(base_frame)) {}

  /// A scanner for scans of either type; returns its number.
  std::size_t addScanner();
  /// Throw BadMessage with the reason; the feed has counted it then.
  void take(std::size_t scanner, const sensor_msgs::LaserScan& message, std::int64_t now);
  void take(std::size_t scanner, const sensor_msgs::MultiEchoLaserScan& message, std::int64_t now);
  void take(std::size_t scanner, const RangeScan& message, std::int64_t now);
  /// Throw BadMessage with the reason.
  void take(const nav_msgs::Odometry& message, std::int64_t now);
  void take(const sensor_msgs::Imu& message, std::int64_t now);

  /// Faults that were mended in messages of a scanner (ScanReader::mended).
  const std::map<std::string, std::string>& mended(std::size_t scanner) const {
    return scanners_[scanner].reader.mended();
  }

 private:
  struct Scanner {
    ScanReader reader;
    RangeScanReader range_reader;
  };
  Eigen::Quaterniond R_base_imu(const std::string& frame) const;

  pipeline::ScanFeed& feed_;
  const pipeline::Transforms& transforms_;
  std::string base_frame_;
  std::vector<Scanner> scanners_;
};

}  // namespace sightline::bridge
