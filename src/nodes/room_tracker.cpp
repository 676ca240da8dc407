#include <cmath>
#include <deque>
#include <memory>
#include <sstream>

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include "nodes/room_tracker_config.h"
#include "sightline/InflateUncertainty.h"
#include "sightline/SetRoom.h"
#include "sightline/bridge/initial_pose.h"
#include "sightline/bridge/input_monitor.h"
#include "sightline/bridge/parameters.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/room_markers.h"
#include "sightline/bridge/room_messages.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/bridge/tracker_settings.h"
#include "sightline/pipeline/scan_motion.h"
#include "sightline/tracking/room_tracker.h"

namespace sightline::nodes {

namespace {

// A scan this much older than the last one means that the clock was set back, not that a message
// came late.
constexpr std::int64_t kClockSetBack = 1'000'000'000;

class RoomTrackerNode {
 public:
  RoomTrackerNode(ros::NodeHandle node, ros::NodeHandle private_node);

 private:
  struct Scanner {
    Scanner(const std::string& topic, const scan::NoiseModel& noise,
            diagnostic_updater::Updater& updater)
        : reader(noise), monitor(topic, updater) {}
    bridge::ScanReader reader;
    bridge::InputMonitor monitor;
    ros::Subscriber subscriber;
  };
  struct Waiting {
    Scanner* scanner;
    sensor_msgs::LaserScanConstPtr message;
    ros::WallTime arrival;
  };

  void addScanner(const std::string& topic);
  void onScan(Scanner& scanner, const sensor_msgs::LaserScanConstPtr& message);
  void onInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message);
  bool onSetRoom(SetRoom::Request& request, SetRoom::Response& response);
  bool onInflate(InflateUncertainty::Request& request, InflateUncertainty::Response& response);
  void processWaiting();
  bool process(const Waiting& waiting);
  bool odometryMayCome(const Waiting& waiting) const;
  bool odometryBeganAfter(const std_msgs::Header& header) const;
  void track(const scan::Scan& scan, const geometry::Pose2& T_odom_base,
             const geometry::Pose2& T_base_sensor, Scanner& scanner);
  void restartAfterClockSetBack(std::int64_t stamp);
  void publish(const tracking::TrackerUpdate& update, const scan::Scan& scan,
               const geometry::Pose2& T_base_sensor);
  void publishInitialising(const scan::Scan& scan);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  ros::NodeHandle node_;
  RoomTrackerNodeConfig config_;
  tracking::RoomTracker tracker_;
  diagnostic_updater::Updater updater_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_{transforms_};
  tf2_ros::TransformBroadcaster broadcaster_;
  std::vector<std::unique_ptr<Scanner>> scanners_;
  std::deque<Waiting> waiting_;
  std::int64_t last_stamp_ = 0;
  TrackerStatus last_status_;
  double odometry_scale_ = 1.0;

  boost::recursive_mutex reconfigure_mutex_;
  dynamic_reconfigure::Server<RoomTrackerConfig> reconfigure_;
  ros::Publisher pose_publisher_;
  ros::Publisher status_publisher_;
  ros::Publisher marker_publisher_;
  ros::Publisher map_publisher_;
  ros::Subscriber initial_pose_subscriber_;
  ros::ServiceServer set_room_server_;
  ros::ServiceServer inflate_server_;
  ros::WallTimer waiting_timer_;
  ros::WallTimer diagnostics_timer_;
};

RoomTrackerNodeConfig readRoomTrackerConfig(const ros::NodeHandle& private_node) {
  auto config = bridge::readParameters<RoomTrackerNodeConfig>(private_node);
  const std::string source = private_node.getNamespace();
  if (config.rooms.empty()) throw config::Error(source, 0, "rooms", "has to name a rooms file");
  if (!config.initial_pose.empty() && config.initial_pose.size() != 3) {
    throw config::Error(source, 0, "initial_pose", "expected x, y and yaw");
  }
  if (config.initial_sigma.size() != 2) {
    throw config::Error(source, 0, "initial_sigma", "expected position and heading");
  }
  return config;
}

RoomTrackerNode::RoomTrackerNode(ros::NodeHandle node, ros::NodeHandle private_node)
    : node_(node),
      config_(readRoomTrackerConfig(private_node)),
      tracker_(config_.tracker, world::RoomMap::readFile(config_.rooms)),
      updater_(node, private_node),
      reconfigure_(reconfigure_mutex_, ros::NodeHandle(private_node, "tracker")) {
  updater_.setHardwareID("none");
  updater_.add("tracking", this, &RoomTrackerNode::report);
  pose_publisher_ = node_.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose", 10);
  status_publisher_ = node_.advertise<TrackerStatus>("tracker_status", 10);
  marker_publisher_ = node_.advertise<visualization_msgs::MarkerArray>("room_markers", 2);
  map_publisher_ = node_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  map_publisher_.publish(bridge::toGridMessage(
      world::drawRooms(tracker_.map(), config_.map_resolution), config_.map_frame));
  if (!config_.initial_pose.empty())
    tracker_.setPose(bridge::startPose(config_.initial_pose, config_.initial_sigma));
  initial_pose_subscriber_ =
      node_.subscribe("initialpose", 1, &RoomTrackerNode::onInitialPose, this);
  set_room_server_ = private_node.advertiseService("set_room", &RoomTrackerNode::onSetRoom, this);
  inflate_server_ =
      private_node.advertiseService("inflate_uncertainty", &RoomTrackerNode::onInflate, this);
  reconfigure_.updateConfig(bridge::toReconfigure(config_.tracker));
  reconfigure_.setCallback([this](RoomTrackerConfig& settings, std::uint32_t) {
    bridge::applyReconfigure(settings, config_.tracker);
    tracker_.configure(config_.tracker);
  });
  std::istringstream topics(config_.scans);
  for (std::string topic; topics >> topic;) addScanner(topic);
  waiting_timer_ = node_.createWallTimer(ros::WallDuration(0.005),
                                         [this](const ros::WallTimerEvent&) { processWaiting(); });
  diagnostics_timer_ = node_.createWallTimer(
      ros::WallDuration(0.5), [this](const ros::WallTimerEvent&) { updater_.update(); });
}

void RoomTrackerNode::addScanner(const std::string& topic) {
  scanners_.push_back(std::make_unique<Scanner>(topic, config_.noise, updater_));
  Scanner& scanner = *scanners_.back();
  scanner.subscriber = node_.subscribe<sensor_msgs::LaserScan>(
      topic, 100, [this, &scanner](const sensor_msgs::LaserScanConstPtr& message) {
        onScan(scanner, message);
      });
}

void RoomTrackerNode::onScan(Scanner& scanner, const sensor_msgs::LaserScanConstPtr& message) {
  waiting_.push_back({&scanner, message, ros::WallTime::now()});
  processWaiting();
}

void RoomTrackerNode::processWaiting() {
  while (!waiting_.empty() && process(waiting_.front())) waiting_.pop_front();
}

// Whether the scan is done with: used, or dropped. A scan whose odometry has yet to come stays.
bool RoomTrackerNode::process(const Waiting& waiting) {
  Scanner& scanner = *waiting.scanner;
  const auto& header = waiting.message->header;
  try {
    const auto mounting = bridge::mountingOf(
        transforms_.lookupTransform(config_.base_frame, header.frame_id, header.stamp).transform);
    scanner.reader.setUpsideDown(mounting.upside_down);
    scan::Scan scan = scanner.reader.read(*waiting.message);
    const auto odometry = pipeline::addMotion(
        scan,
        [this](std::int64_t stamp) -> std::optional<geometry::Pose2> {
          return bridge::toPose2(
              transforms_
                  .lookupTransform(config_.odom_frame, config_.base_frame, bridge::timeOf(stamp))
                  .transform);
        },
        mounting.T_base_sensor);
    track(scan, *odometry, mounting.T_base_sensor, scanner);
    return true;
  } catch (const scan::InvalidScan& fault) {
    scanner.monitor.drop(fault.what());
    return true;
  } catch (const tf2::TransformException& missing) {
    if (odometryMayCome(waiting)) return false;
    if (odometryBeganAfter(header)) {
      scanner.monitor.skip("it is from before the odometry began");
    } else {
      scanner.monitor.drop(missing.what());
    }
    return true;
  }
}

bool RoomTrackerNode::odometryMayCome(const Waiting& waiting) const {
  return (ros::WallTime::now() - waiting.arrival).toSec() < config_.odometry_timeout &&
         !odometryBeganAfter(waiting.message->header);
}

// Such a scan would wait in vain, and hold up those behind it: in a recording played fast, until tf
// had forgotten their odometry too. The newest is asked for first, as more may come in between.
bool RoomTrackerNode::odometryBeganAfter(const std_msgs::Header& header) const {
  try {
    const auto newest =
        transforms_.lookupTransform(config_.odom_frame, header.frame_id, ros::Time(0));
    return newest.header.stamp > header.stamp &&
           !transforms_.canTransform(config_.odom_frame, header.frame_id, header.stamp);
  } catch (const tf2::TransformException&) {
    return false;
  }
}

void RoomTrackerNode::restartAfterClockSetBack(std::int64_t stamp) {
  if (stamp >= last_stamp_ - kClockSetBack) return;
  ROS_WARN("the clock was set back by %.1f s: tracking starts again",
           1e-9 * static_cast<double>(last_stamp_ - stamp));
  last_stamp_ = 0;
  if (config_.initial_pose.empty()) {
    tracker_.restartClock();
  } else {
    tracker_.setPose(bridge::startPose(config_.initial_pose, config_.initial_sigma));
  }
}

void RoomTrackerNode::track(const scan::Scan& scan, const geometry::Pose2& T_odom_base,
                            const geometry::Pose2& T_base_sensor, Scanner& scanner) {
  restartAfterClockSetBack(scan.stamp);
  if (scan.stamp < last_stamp_) {
    scanner.monitor.drop("older than the last scan used");
    return;
  }
  scanner.monitor.accept();
  last_stamp_ = scan.stamp;
  const auto update = tracker_.update(scan, T_odom_base, T_base_sensor);
  if (update) {
    publish(*update, scan, T_base_sensor);
  } else {
    publishInitialising(scan);
  }
}

void RoomTrackerNode::publish(const tracking::TrackerUpdate& update, const scan::Scan& scan,
                              const geometry::Pose2& T_base_sensor) {
  pose_publisher_.publish(bridge::toPoseMessage(update, config_.map_frame));
  last_status_ = bridge::toStatusMessage(update, tracker_.map(), config_.map_frame);
  odometry_scale_ = update.odometry_scale;
  status_publisher_.publish(last_status_);
  if (config_.publish_tf) {
    auto transform = bridge::toMapOdom(update, config_.map_frame, config_.odom_frame);
    transform.header.stamp += ros::Duration(config_.transform_tolerance);
    broadcaster_.sendTransform(transform);
  }
  if (marker_publisher_.getNumSubscribers() > 0) {
    marker_publisher_.publish(
        bridge::roomMarkers(update, tracker_.map(), scan, T_base_sensor, config_.map_frame));
  }
}

void RoomTrackerNode::publishInitialising(const scan::Scan& scan) {
  last_status_ = TrackerStatus();
  last_status_.header.stamp = bridge::timeOf(scan.stamp);
  last_status_.header.frame_id = config_.map_frame;
  status_publisher_.publish(last_status_);
}

void RoomTrackerNode::onInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  try {
    tracker_.setPose(bridge::readInitialPose(message, config_.map_frame, config_.initial_sigma));
    ROS_INFO("tracking starts at (%.2f, %.2f)", message.pose.pose.position.x,
             message.pose.pose.position.y);
  } catch (const std::invalid_argument& fault) {
    ROS_ERROR("initialpose refused: %s", fault.what());
  }
}

bool RoomTrackerNode::onSetRoom(SetRoom::Request& request, SetRoom::Response& response) {
  response.success = tracker_.setRoom(request.room);
  if (!response.success) response.message = "no room is called '" + request.room + "'";
  return true;
}

bool RoomTrackerNode::onInflate(InflateUncertainty::Request& request,
                                InflateUncertainty::Response& response) {
  response.success = request.position >= 0.0 && request.heading >= 0.0 &&
                     std::isfinite(request.position) && std::isfinite(request.heading);
  if (response.success) {
    tracker_.inflate(request.position, request.heading);
  } else {
    response.message = "standard deviations have to be finite and not negative";
  }
  return true;
}

void RoomTrackerNode::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  switch (last_status_.state) {
    case TrackerStatus::TRACKING:
      status.summary(DiagnosticStatus::OK, "tracking");
      break;
    case TrackerStatus::DEGRADED:
      status.summary(DiagnosticStatus::WARN, "degraded: the pose is vague");
      break;
    case TrackerStatus::LOST:
      status.summary(DiagnosticStatus::ERROR, "lost: the scans do not fit the room");
      break;
    default:
      status.summary(DiagnosticStatus::WARN, "no pose yet: set initial_pose or send initialpose");
  }
  status.add("room", last_status_.room);
  status.add("quality", last_status_.quality);
  status.add("odometry scale", odometry_scale_);
}

}  // namespace

std::shared_ptr<void> makeRoomTracker(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<RoomTrackerNode>(node, private_node);
}

}  // namespace sightline::nodes
