#include "sightline/bridge/live_feed.h"

#include <chrono>
#include <utility>

namespace sightline::bridge {

namespace {

// Scans and readings that may queue up while a node is held up.
constexpr std::uint32_t kScanQueue = 100;
constexpr std::uint32_t kReadingQueue = 500;
// Time between two looks at the scans that wait.
const ros::WallDuration kRound(0.005);

std::int64_t steadyNow() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace

LiveFeed::LiveFeed(ros::NodeHandle node, const pipeline::InputConfig& config,
                   const pipeline::Frames& frames, const pipeline::FeedNeeds& needs,
                   diagnostic_updater::Updater& updater, Consumer consumer)
    : updater_(updater),
      consumer_(std::move(consumer)),
      feed_(config.feed, frames, needs, transforms_),
      input_(feed_, transforms_, frames.base) {
  const auto source = config.feed.odometry_source;
  const bool by_topic =
      source == pipeline::OdometrySource::kAutomatic || source == pipeline::OdometrySource::kTopic;
  if (needs.odometry && by_topic) {
    subscribe<nav_msgs::Odometry>(node, config.odometry_topic, odometry_);
  }
  if (needs.mounting && config.feed.use_imu) {
    subscribe<sensor_msgs::Imu>(node, config.imu_topic, imu_);
  }
  for (const auto& topic : config.laserTopics()) addScanner<sensor_msgs::LaserScan>(node, topic);
  for (const auto& topic : config.range_scans) addScanner<RangeScan>(node, topic);
  timer_ = node.createSteadyTimer(kRound, [this](const ros::SteadyTimerEvent&) { deliver(); });
}

template <class Message>
void LiveFeed::addScanner(ros::NodeHandle& node, const std::string& topic) {
  const std::size_t scanner = input_.addScanner();
  topics_.push_back(topic);
  scanners_.push_back({});
  scanners_.back().monitor = std::make_unique<InputMonitor>(node.resolveName(topic), updater_);
  scanners_.back().subscriber = node.subscribe<Message>(
      topic, kScanQueue,
      [this, scanner](const typename Message::ConstPtr& message) { onScan(scanner, *message); },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

template <class Message>
void LiveFeed::subscribe(ros::NodeHandle& node, const std::string& topic, Input& input) {
  input.subscriber = node.subscribe<Message>(
      topic, kReadingQueue,
      [this, &input](const typename Message::ConstPtr& message) {
        if (!input.monitor) {
          input.monitor = std::make_unique<InputMonitor>(input.subscriber.getTopic(), updater_);
        }
        input.monitor->use([&] { input_.take(*message); });
        deliver();
      },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

template <class Message>
void LiveFeed::onScan(std::size_t scanner, const Message& message) {
  try {
    input_.take(scanner, message, steadyNow());
  } catch (const BadMessage& fault) {
    scanners_[scanner].monitor->drop(fault.what());
  }
  deliver();
}

void LiveFeed::deliver() {
  while (auto result = feed_.next(steadyNow())) deliver(*result);
}

void LiveFeed::deliver(pipeline::FeedResult& result) {
  InputMonitor& monitor = *scanners_[result.scanner].monitor;
  if (const auto* noise = feed_.learnedNoise(result.scanner)) monitor.show(*noise);
  if (!result.located) return monitor.drop(result.reason);
  try {
    consumer_(std::move(*result.located));
    monitor.accept();
  } catch (const scan::InvalidScan& fault) {
    monitor.drop(fault.what());
  } catch (const UnusedScan& reason) {
    reason.is_blameless ? monitor.skip(reason.what()) : monitor.drop(reason.what());
  }
}

}  // namespace sightline::bridge
