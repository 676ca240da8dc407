#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>
#include <boost/make_shared.hpp>

#include "nodes/laser_odometry_config.h"
#include "sightline/bridge/input_monitor.h"
#include "sightline/bridge/laser_odometry_messages.h"
#include "sightline/bridge/motion_inputs.h"
#include "sightline/bridge/parameters.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"

namespace sightline::nodes {

namespace {

using dead_reckoning::DeadReckoningUpdate;
using dead_reckoning::MatchState;

// A scan this much older than the last one means that the clock was set back, not that a message
// came late.
constexpr std::int64_t kSetBack = 1'000'000'000;

// When the last beam left; the stamp where the message is no good [ns].
std::int64_t endOf(const sensor_msgs::LaserScan& message) {
  constexpr double kLongestSweep = 60.0;  // s
  const double sweep = message.time_increment * static_cast<double>(message.ranges.size());
  const bool is_good = sweep > 0.0 && sweep < kLongestSweep;
  return bridge::nanoseconds(message.header.stamp) + (is_good ? std::llround(1e9 * sweep) : 0);
}

class LaserOdometryNode {
 public:
  LaserOdometryNode(ros::NodeHandle node, ros::NodeHandle private_node);

 private:
  struct Waiting {
    sensor_msgs::LaserScanConstPtr message;
    ros::WallTime arrival;
    double age() const { return (ros::WallTime::now() - arrival).toSec(); }
  };

  void onScan(const sensor_msgs::LaserScanConstPtr& message);
  void processWaiting();
  bool process(const Waiting& waiting);
  bool findMounting(const Waiting& waiting);
  void estimate(const sensor_msgs::LaserScan& message);
  void restartAfterClockSetBack(std::int64_t stamp);
  void publish(const DeadReckoningUpdate& update);
  void warn(const DeadReckoningUpdate& update) const;
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  LaserOdometryNodeConfig config_;
  bridge::ScanReader reader_;
  pipeline::ScanOdometry odometry_;
  diagnostic_updater::Updater updater_;
  bridge::InputMonitor monitor_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_{transforms_};
  tf2_ros::TransformBroadcaster broadcaster_;
  bridge::MotionInputs inputs_;
  std::deque<Waiting> waiting_;
  std::optional<bridge::Mounting> mounting_;
  bool is_mounting_known_ = false;
  std::optional<std::int64_t> last_stamp_;
  DeadReckoningUpdate last_update_;
  std::array<std::size_t, 5> states_{};  // how many scans each state had
  std::size_t flagged_before_ = 0;       // at the last report

  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  ros::ServiceServer reset_server_;
  ros::WallTimer waiting_timer_;
  ros::WallTimer diagnostics_timer_;
};

LaserOdometryNode::LaserOdometryNode(ros::NodeHandle node, ros::NodeHandle private_node)
    : config_(bridge::readParameters<LaserOdometryNodeConfig>(private_node)),
      reader_(config_.noise),
      odometry_(config_.odometry),
      updater_(node, private_node),
      monitor_(node.resolveName("scan"), updater_),
      inputs_(node, {config_.base_frame, config_.use_wheels, config_.use_imu}, transforms_,
              updater_) {
  updater_.setHardwareID("none");
  updater_.add("odometry", this, &LaserOdometryNode::report);
  publisher_ = node.advertise<nav_msgs::Odometry>("laser_odom", 10);
  subscriber_ = node.subscribe("scan", 20, &LaserOdometryNode::onScan, this,
                               ros::TransportHints().tcpNoDelay());
  reset_server_ = private_node.advertiseService("reset", &LaserOdometryNode::onReset, this);
  waiting_timer_ = node.createWallTimer(ros::WallDuration(0.01),
                                        [this](const ros::WallTimerEvent&) { processWaiting(); });
  diagnostics_timer_ = node.createWallTimer(
      ros::WallDuration(0.5), [this](const ros::WallTimerEvent&) { updater_.update(); });
}

void LaserOdometryNode::onScan(const sensor_msgs::LaserScanConstPtr& message) {
  waiting_.push_back({message, ros::WallTime::now()});
  processWaiting();
}

void LaserOdometryNode::processWaiting() {
  while (!waiting_.empty() && process(waiting_.front())) waiting_.pop_front();
}

// Whether the scan is done with: used, or dropped. One whose mounting or prior may come stays.
bool LaserOdometryNode::process(const Waiting& waiting) {
  const sensor_msgs::LaserScan& message = *waiting.message;
  try {
    if (!findMounting(waiting)) return false;
    if (waiting.age() < config_.prior_timeout && inputs_.isBehind(endOf(message))) return false;
    estimate(message);
  } catch (const scan::InvalidScan& fault) {
    monitor_.drop(fault.what());
  } catch (const tf2::TransformException& missing) {
    monitor_.drop(missing.what());
  }
  return true;
}

// False while the transform may still come. Throws tf2::TransformException where it does not, for a
// scanner whose mounting was known before.
bool LaserOdometryNode::findMounting(const Waiting& waiting) {
  const auto& header = waiting.message->header;
  try {
    const auto transform =
        transforms_.lookupTransform(config_.base_frame, header.frame_id, header.stamp);
    // What was found so far was of the scanner, not of the base.
    if (mounting_ && !is_mounting_known_) odometry_.reset();
    mounting_ = bridge::mountingOf(transform.transform);
    is_mounting_known_ = true;
  } catch (const tf2::TransformException& missing) {
    // Known, but not of that time: a scan from before it began, or from long ago.
    const bool is_known =
        is_mounting_known_ ||
        transforms_.canTransform(config_.base_frame, header.frame_id, ros::Time(0));
    if (is_known && waiting.age() >= config_.prior_timeout) throw;
    if (is_known) return false;
    if (mounting_) return true;
    if (waiting.age() < config_.mounting_timeout) return false;
    ROS_WARN("the scanner is taken for the base: %s", missing.what());
    mounting_ = bridge::Mounting{};
  }
  return true;
}

void LaserOdometryNode::restartAfterClockSetBack(std::int64_t stamp) {
  if (!last_stamp_ || stamp >= *last_stamp_ - kSetBack) return;
  ROS_WARN("the clock was set back by %.1f s: odometry goes on from where it is",
           1e-9 * static_cast<double>(*last_stamp_ - stamp));
  last_stamp_.reset();
  odometry_.restartClock();
}

void LaserOdometryNode::estimate(const sensor_msgs::LaserScan& message) {
  reader_.setUpsideDown(mounting_->upside_down);
  scan::Scan scan = reader_.read(message);
  restartAfterClockSetBack(scan.stamp);
  const auto aids = inputs_.aidsFor(scan, mounting_->T_base_sensor, last_stamp_);
  const auto update = odometry_.update(scan, mounting_->T_base_sensor, aids);
  if (!update) return monitor_.drop("not newer than the last scan used");
  monitor_.accept();
  last_stamp_ = scan.stamp;
  publish(*update);
}

void LaserOdometryNode::publish(const DeadReckoningUpdate& update) {
  last_update_ = update;
  ++states_[static_cast<std::size_t>(update.state)];
  const auto message = boost::make_shared<nav_msgs::Odometry>(
      bridge::toLaserOdometryMessage(update, config_.odom_frame, config_.base_frame));
  publisher_.publish(message);
  if (config_.publish_tf) {
    geometry_msgs::TransformStamped transform;
    transform.header = message->header;
    transform.child_frame_id = message->child_frame_id;
    transform.transform = bridge::toTransform(update.pose.mean);
    broadcaster_.sendTransform(transform);
  }
  if (update.isFlagged()) warn(update);
}

void LaserOdometryNode::warn(const DeadReckoningUpdate& update) const {
  ROS_WARN_THROTTLE(10.0, "scan %.3f: match %s, %.0f %% of %zu beams found their counterpart",
                    bridge::timeOf(update.stamp).toSec(), bridge::nameOf(update.state),
                    100.0 * update.inliers, update.beams);
}

bool LaserOdometryNode::onReset(std_srvs::Trigger::Request&,
                                std_srvs::Trigger::Response& response) {
  odometry_.reset();
  last_stamp_.reset();
  response.success = true;
  response.message = "odometry starts anew with the next scan";
  return true;
}

void LaserOdometryNode::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const auto count = [this](MatchState state) { return states_[static_cast<std::size_t>(state)]; };
  const std::size_t flagged =
      count(MatchState::kAmbiguous) + count(MatchState::kRecovered) + count(MatchState::kFailed);
  if (last_update_.stamp == 0) {
    status.summary(DiagnosticStatus::WARN, "no scan used yet");
  } else if (flagged == flagged_before_) {
    status.summary(DiagnosticStatus::OK, "scans match");
  } else if (last_update_.state == MatchState::kFailed) {
    status.summary(DiagnosticStatus::ERROR, "the last scan does not match: bridged");
  } else {
    status.summary(DiagnosticStatus::WARN, "some of the last scans were doubtful");
  }
  flagged_before_ = flagged;
  for (const MatchState state : {MatchState::kInitial, MatchState::kMatched, MatchState::kAmbiguous,
                                 MatchState::kRecovered, MatchState::kFailed}) {
    status.add(bridge::nameOf(state), count(state));
  }
  const auto& floor = odometry_.beamsOnFloor();
  status.add("beams in the last scan", last_update_.beams);
  status.add("share of them matched", last_update_.inliers);
  status.add("beams on floor or ceiling", std::count(floor.begin(), floor.end(), true));
  status.add("mounting", is_mounting_known_ ? "from tf" : "none: the scanner is the base");
}

}  // namespace

std::shared_ptr<void> makeLaserOdometry(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<LaserOdometryNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
