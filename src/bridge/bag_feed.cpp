#include "sightline/bridge/bag_feed.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <tf2_msgs/TFMessage.h>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/config/error.h"

namespace sightline::bridge {

namespace {

bool isScan(const std::string& type) {
  namespace traits = ros::message_traits;
  return type == traits::datatype<sensor_msgs::LaserScan>() ||
         type == traits::datatype<sensor_msgs::MultiEchoLaserScan>() ||
         type == traits::datatype<RangeScan>();
}

bool isBag(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string start(8, '\0');
  return file.read(start.data(), 8) && start == "#ROSBAG ";
}

std::string reindexing(const std::string& path) {
  return fmt::format("rosbag reindex '{}'", path);
}

// Topics that hold scans, as they stand in the bags.
std::set<std::string> scanTopics(rosbag::View& view) {
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    if (isScan(connection->datatype)) topics.insert(connection->topic);
  }
  return topics;
}

}  // namespace

tf2_msgs::TFMessage mountingTransforms(const pipeline::EstimatorsConfig& config) {
  tf2_msgs::TFMessage message;
  for (const auto& [frame, T_base_sensor] : config.mountings) {
    message.transforms.push_back(
        toTransformMessage(config.frames.base, withoutSlash(frame), 0, T_base_sensor));
  }
  return message;
}

BagFeed::BagFeed(const std::vector<std::string>& paths, const pipeline::EstimatorsConfig& config,
                 const pipeline::FeedNeeds& needs)
    : paths_(fmt::format("{}", fmt::join(paths, ", "))),
      feed_(config.input.feed, config.frames, needs, transforms_),
      input_(feed_, transforms_, config.frames.base),
      readings_{withoutSlash(config.input.odometry_topic), withoutSlash(config.input.imu_topic)} {
  for (const auto& transform : mountingTransforms(config).transforms) {
    buffer_.setTransform(transform, "settings", /*is_static=*/true);
  }
  for (const std::string& path : paths) open(path);
  for (const std::string& topic : config.input.topics()) addScanner(topic);
}

// rosbag does not say which file is at fault.
void openToRead(rosbag::Bag& bag, const std::string& path) {
  try {
    bag.open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw config::Error(path, 0, "", "it was not closed, and has no index: " + reindexing(path));
  } catch (const ros::Exception& fault) {
    // What is cut within its records is found by many names.
    const bool is_cut = isBag(path);
    throw config::Error(path, 0, "",
                        is_cut ? "it is cut short: " + reindexing(path) : fault.what());
  }
}

void BagFeed::open(const std::string& path) {
  bags_.emplace_back();
  openToRead(bags_.back(), path);
}

void BagFeed::addScanner(const std::string& topic) {
  std::set<std::string> known;
  for (const rosbag::Bag& bag : bags_) {
    rosbag::View view(bag);
    known.merge(scanTopics(view));
  }
  const std::string name = withoutSlash(topic);
  if (known.count(name) == 0 && known.count("/" + name) == 0) {
    throw config::Error(
        paths_, 0, "",
        fmt::format("no scans on /{}; there are: {}", name,
                    known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
  }
  scanners_[name] = input_.addScanner();
}

void BagFeed::read(const Visitor& visitor) {
  try {
    readAll(visitor);
  } catch (const rosbag::BagException& fault) {
    damage_ =
        fmt::format("{} is damaged, and was read as far as it goes: {}", paths_, fault.what());
  }
  deliver(last_, /*at_end=*/true, visitor);
}

// What never changes holds before it was said, too.
void BagFeed::takeStaticTransforms() {
  const std::vector<std::string> topics{"tf_static", "/tf_static"};
  for (const rosbag::Bag& bag : bags_) {
    rosbag::View view(bag, rosbag::TopicQuery(topics));
    for (const rosbag::MessageInstance& instance : view) {
      const auto transforms = instance.instantiate<tf2_msgs::TFMessage>();
      if (transforms) transform_input_.take(*transforms, /*is_static=*/true, 0);
    }
  }
}

void BagFeed::readAll(const Visitor& visitor) {
  takeStaticTransforms();
  std::vector<std::string> names{"tf", "tf_static"};
  for (const auto& [topic, scanner] : scanners_) names.push_back(topic);
  names.insert(names.end(), readings_.begin(), readings_.end());
  std::vector<std::string> topics = names;
  for (const std::string& name : names) topics.push_back("/" + name);
  rosbag::View view;
  for (const rosbag::Bag& bag : bags_) view.addQuery(bag, rosbag::TopicQuery(topics));
  const ros::Time begin = view.getBeginTime();
  const double length = std::max((view.getEndTime() - begin).toSec(), 1e-9);
  for (const rosbag::MessageInstance& instance : view) {
    last_ = instance.getTime();
    visitor.message(instance);
    take(instance);
    deliver(instance.getTime(), /*at_end=*/false, visitor);
    visitor.progress((instance.getTime() - begin).toSec() / length);
  }
}

void BagFeed::take(const rosbag::MessageInstance& instance) {
  const std::string topic = withoutSlash(instance.getTopic());
  const auto scanner = scanners_.find(topic);
  if (scanner != scanners_.end()) return takeScan(scanner->second, instance);
  if (const auto transforms = instance.instantiate<tf2_msgs::TFMessage>()) {
    return takeTransforms(*transforms, topic, nanoseconds(instance.getTime()));
  }
  try {
    takeReading(instance);
  } catch (const BadMessage& fault) {
    ++refused_[topic + ": " + fault.what()];
  }
}

void BagFeed::takeTransforms(const tf2_msgs::TFMessage& message, const std::string& topic,
                             std::int64_t now) {
  for (const std::string& fault : transform_input_.take(message, topic == "tf_static", now)) {
    ++refused_[topic + ": " + fault];
  }
}

void BagFeed::takeScan(std::size_t scanner, const rosbag::MessageInstance& instance) {
  if (first_scan_.isZero()) first_scan_ = instance.getTime();
  last_scan_ = instance.getTime();
  const std::int64_t now = nanoseconds(instance.getTime());
  try {
    if (const auto laser = instance.instantiate<sensor_msgs::LaserScan>()) {
      input_.take(scanner, *laser, now);
    } else if (const auto echoes = instance.instantiate<sensor_msgs::MultiEchoLaserScan>()) {
      input_.take(scanner, *echoes, now);
    } else if (const auto range_scan = instance.instantiate<RangeScan>()) {
      input_.take(scanner, *range_scan, now);
    }
  } catch (const BadMessage&) {
    // The feed has counted it with its reason.
  }
}

void BagFeed::takeReading(const rosbag::MessageInstance& instance) {
  const std::int64_t now = nanoseconds(instance.getTime());
  if (const auto odometry = instance.instantiate<nav_msgs::Odometry>()) {
    input_.take(*odometry, now);
  } else if (const auto imu = instance.instantiate<sensor_msgs::Imu>()) {
    input_.take(*imu, now);
  }
}

void BagFeed::deliver(const ros::Time& now, bool at_end, const Visitor& visitor) {
  const auto next = [&] { return at_end ? feed_.flush() : feed_.next(nanoseconds(now)); };
  while (auto result = next()) {
    if (!result->located) continue;
    if (result->located->clock_restarted) ++restarts_;
    visitor.scan(std::move(*result->located), now);
  }
}

std::size_t BagFeed::scans() const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < feed_.scanners(); ++i) sum += feed_.counts(i).arrived;
  return sum;
}

std::size_t BagFeed::withoutMotion() const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < feed_.scanners(); ++i) sum += feed_.counts(i).without_motion;
  return sum;
}

std::size_t BagFeed::breaks() const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < feed_.scanners(); ++i) sum += feed_.counts(i).odometry_broke;
  return sum;
}

std::vector<std::string> BagFeed::faultsOfTurns() const {
  std::vector<std::string> texts;
  for (const auto& [topic, scanner] : scanners_) {
    const std::size_t count = feed_.counts(scanner).turns_opposite;
    if (count > 0) texts.push_back(fmt::format("/{}: {} ({} scans)", topic, kTurnsOpposite, count));
    const std::string fault = feed_.timingFault(scanner);
    if (!fault.empty()) texts.push_back(fmt::format("/{}: {}", topic, fault));
  }
  return texts;
}

std::vector<std::string> BagFeed::mended() const {
  std::vector<std::string> texts;
  for (const auto& [topic, scanner] : scanners_) {
    for (const auto& [field, text] : input_.mended(scanner)) {
      texts.push_back(fmt::format("/{}: {}", topic, text));
    }
  }
  return texts;
}

std::map<std::string, std::size_t> BagFeed::dropped() const {
  std::map<std::string, std::size_t> sum;
  for (std::size_t i = 0; i < feed_.scanners(); ++i) {
    for (const auto& [reason, count] : feed_.counts(i).dropped) sum[reason] += count;
  }
  return sum;
}

}  // namespace sightline::bridge
