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
      input_(feed_, transforms_, frames.base),
      awaited_text_(node, frames.base, [this] { return awaited(); }) {
  subscribeTransforms(node, "/tf", tf_);
  subscribeTransforms(node, "/tf_static", tf_static_);
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
  for (const auto& topic : config.echo_scans) {
    addScanner<sensor_msgs::MultiEchoLaserScan>(node, topic);
  }
  constexpr bool kOnce = false;
  constexpr bool kStarts = false;
  timer_ = node.createSteadyTimer(
      kRound, [this](const ros::SteadyTimerEvent&) { deliver(); }, kOnce, kStarts);
}

template <class Message>
void LiveFeed::addScanner(ros::NodeHandle& node, const std::string& topic) {
  const std::size_t scanner = input_.addScanner();
  topics_.push_back(topic);
  scanners_.push_back({});
  scanners_.back().monitor =
      std::make_unique<InputMonitor>(node.resolveName(topic), updater_, InputMonitor::Flow::kSteady,
                                     ros::message_traits::datatype<Message>());
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
        input.monitor->use([&] { input_.take(*message, steadyNow()); });
        deliver();
      },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

// tf2's own listener would take what a robot broadcasts as it is, and keep what is from the future
// of a clock that was set back.
void LiveFeed::subscribeTransforms(ros::NodeHandle& node, const std::string& topic, Input& input) {
  const bool is_static = topic == "/tf_static";
  input.subscriber = node.subscribe<tf2_msgs::TFMessage>(
      topic, kReadingQueue,
      [this, is_static, topic, &input](const tf2_msgs::TFMessage::ConstPtr& message) {
        const auto faults = transform_input_.take(*message, is_static, steadyNow());
        for (const std::string& fault : faults) {
          if (!input.monitor) input.monitor = std::make_unique<InputMonitor>(topic, updater_);
          input.monitor->drop(fault);
        }
        if (faults.empty() && input.monitor) input.monitor->accept();
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
  for (const auto& [field, fault] : input_.mended(scanner)) {
    scanners_[scanner].monitor->note(field, fault);
  }
  deliver();
}

std::string LiveFeed::awaited() const {
  for (const Input& scanner : scanners_) {
    std::string text = scanner.monitor->awaited();
    if (!text.empty()) return text;
  }
  return "";
}

// The timer runs only while scans wait: its rounds would cost a node more than its work.
void LiveFeed::deliver() {
  while (auto result = feed_.next(steadyNow())) deliver(*result);
  feed_.isWaiting() ? timer_.start() : timer_.stop();
}

void LiveFeed::deliver(pipeline::FeedResult& result) {
  InputMonitor& monitor = *scanners_[result.scanner].monitor;
  if (const auto* noise = feed_.learnedNoise(result.scanner)) monitor.show(*noise);
  if (!result.located) return monitor.drop(result.reason);
  if (result.located->clock_restarted) {
    monitor.warn("the clock was set: started again in the new time");
  }
  if (result.located->odometry_broke) {
    monitor.warn("the odometry was reset or leaped: bridged by the scans");
  }
  if (result.located->turns_opposite) monitor.warn(kTurnsOpposite);
  if (const auto fault = feed_.timingFault(result.scanner); !fault.empty()) monitor.warn(fault);
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
