#include "sightline/bridge/feed_input.h"

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/imu_conversion.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"

namespace sightline::bridge {

std::size_t FeedInput::addScanner() {
  scanners_.emplace_back();
  return feed_.addScanner();
}

void FeedInput::take(std::size_t scanner, const sensor_msgs::LaserScan& message, std::int64_t now) {
  try {
    feed_.add(scanner, scanners_[scanner].reader.read(message), now);
  } catch (const scan::InvalidScan& fault) {
    feed_.refuse(scanner, fault.what());
    throw BadMessage(fault.what());
  }
}

void FeedInput::take(std::size_t scanner, const sensor_msgs::MultiEchoLaserScan& message,
                     std::int64_t now) {
  take(scanner, firstEchoes(message), now);
}

void FeedInput::take(std::size_t scanner, const RangeScan& message, std::int64_t now) {
  try {
    feed_.add(scanner, scanners_[scanner].range_reader.read(message), now);
  } catch (const scan::InvalidScan& fault) {
    feed_.refuse(scanner, fault.what());
    throw BadMessage(fault.what());
  }
}

void FeedInput::take(const nav_msgs::Odometry& message, std::int64_t now) {
  const auto& position = message.pose.pose.position;
  std::string fault =
      faultOfPose({position.x, position.y, position.z}, message.pose.pose.orientation);
  if (fault.empty()) {
    fault = feed_.addOdometry(nanoseconds(message.header.stamp), toPose2(message.pose.pose), now);
  }
  if (!fault.empty()) throw BadMessage(fault);
}

void FeedInput::take(const sensor_msgs::Imu& message, std::int64_t now) {
  const std::string fault =
      feed_.addImu(readImu(message, R_base_imu(message.header.frame_id)), now);
  if (!fault.empty()) throw BadMessage(fault);
}

// A sensor that no transform leads to is taken to sit straight on the base.
Eigen::Quaterniond FeedInput::R_base_imu(const std::string& frame) const {
  const auto found = transforms_.newest(base_frame_, frame);
  if (!found) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(found->T_target_source.linear());
}

}  // namespace sightline::bridge
