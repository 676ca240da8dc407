#include "sightline/bridge/bag_scans.h"

#include <set>

#include <fmt/format.h>
#include <rosbag/view.h>

#include "sightline/bridge/mountings.h"
#include "sightline/bridge/time.h"
#include "sightline/config/error.h"
#include "sightline/pipeline/scan_motion.h"

namespace sightline::bridge {

namespace {

using geometry::Pose2;

const ros::Duration kLongestWait(1.0);

// Topics in a bag are written from the root, those in settings are relative.
std::string fromRoot(const std::string& topic) {
  return topic.rfind('/', 0) == 0 ? topic : "/" + topic;
}

std::set<std::string> laserTopics(rosbag::View& view) {
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    if (connection->datatype == "sensor_msgs/LaserScan") topics.insert(connection->topic);
  }
  return topics;
}

}  // namespace

BagScans::BagScans(const std::string& path, const pipeline::OfflineConfig& config, bool use_wheels)
    : path_(path), frames_(config.frames), use_wheels_(use_wheels) {
  for (const std::string& topic : config.scans) readers_.emplace(fromRoot(topic), config.noise);
  transforms_.add(mountingTransforms(config), /*is_static=*/true);
  withPath([&] { bag_.open(path, rosbag::bagmode::Read); });
  checkTopics();
}

// rosbag does not say which file is at fault.
template <class Call>
void BagScans::withPath(const Call& call) const {
  try {
    call();
  } catch (const ros::Exception& fault) {
    throw config::Error(path_, 0, "", fault.what());
  }
}

void BagScans::checkTopics() {
  rosbag::View view(bag_);
  const auto known = laserTopics(view);
  for (const auto& [topic, reader] : readers_) {
    if (known.count(topic) > 0) continue;
    throw config::Error(
        path_, 0, "",
        fmt::format("no sensor_msgs/LaserScan on {}; there are: {}", topic,
                    known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
  }
}

void BagScans::read(const Visitor& visitor) {
  withPath([&] { readAll(visitor); });
}

void BagScans::readAll(const Visitor& visitor) {
  std::vector<std::string> topics{"/tf", "/tf_static"};
  for (const auto& [topic, reader] : readers_) topics.push_back(topic);
  rosbag::View view(bag_, rosbag::TopicQuery(topics));
  const ros::Time begin = view.getBeginTime();
  const double length = std::max((view.getEndTime() - begin).toSec(), 1e-9);
  for (const rosbag::MessageInstance& instance : view) {
    visitor.message(instance);
    take(instance, visitor);
    visitor.progress((instance.getTime() - begin).toSec() / length);
  }
  releaseWaiting(view.getEndTime(), /*at_end=*/true, visitor);
}

void BagScans::take(const rosbag::MessageInstance& instance, const Visitor& visitor) {
  const auto reader = readers_.find(instance.getTopic());
  if (reader != readers_.end()) {
    takeScan(instance, reader->second);
  } else if (const auto transforms = instance.instantiate<tf2_msgs::TFMessage>()) {
    transforms_.add(*transforms, instance.getTopic() == "/tf_static");
  }
  releaseWaiting(instance.getTime(), /*at_end=*/false, visitor);
}

void BagScans::takeScan(const rosbag::MessageInstance& instance, ScanReader& reader) {
  const auto message = instance.instantiate<sensor_msgs::LaserScan>();
  if (!message) return;
  if (scans_++ == 0) first_scan_ = instance.getTime();
  last_scan_ = instance.getTime();
  waiting_.push_back({&reader, message, instance.getTime(), {}, false});
}

void BagScans::releaseWaiting(const ros::Time& now, bool at_end, const Visitor& visitor) {
  while (!waiting_.empty()) {
    Waiting& front = waiting_.front();
    try {
      if (!complete(front, at_end || now - front.arrival > kLongestWait)) return;
      visitor.scan(front.located, now);
    } catch (const scan::InvalidScan& fault) {
      ++dropped_[fault.what()];
    }
    waiting_.pop_front();
  }
}

// Whether a scan has all that it is given, or has waited long enough. The mounting comes first: it
// tells which way the scan turns.
bool BagScans::complete(Waiting& waiting, bool is_late) {
  LocatedScan& located = waiting.located;
  const auto& header = waiting.message->header;
  if (!waiting.was_read) {
    const auto transform = transforms_.at(frames_.base, header.frame_id, nanoseconds(header.stamp));
    if (!transform && !is_late) return false;
    const Mounting mounting = transform ? mountingOf(*transform) : Mounting{};
    if (transform) located.T_base_sensor = mounting.T_base_sensor;
    waiting.reader->setUpsideDown(mounting.upside_down);
    located.scan = waiting.reader->read(*waiting.message);
    waiting.was_read = true;
  }
  if (!use_wheels_ || !located.T_base_sensor) return true;
  addMotion(located);
  return located.T_odom_base || is_late;
}

void BagScans::addMotion(LocatedScan& located) {
  const auto odometry = [this](std::int64_t stamp) -> std::optional<Pose2> {
    const auto transform = transforms_.at(frames_.odom, frames_.base, stamp);
    if (!transform) return std::nullopt;
    return toPose2(*transform);
  };
  located.T_odom_base = pipeline::addMotion(located.scan, odometry, *located.T_base_sensor);
}

}  // namespace sightline::bridge
