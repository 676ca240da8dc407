#include <algorithm>
#include <memory>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_ros/transform_listener.h>

#include <sightline/HeadCommand.h>
#include "nodes/gaze_config.h"
#include "nodes/gaze_controls.h"
#include "sightline/bridge/feature_messages.h"
#include "sightline/bridge/gaze_markers.h"
#include "sightline/bridge/initial_pose.h"
#include "sightline/bridge/node_diagnostics.h"
#include "sightline/bridge/parameters.h"
#include "sightline/bridge/range_scan_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/geometry/isometry.h"

namespace sightline::nodes {

namespace {

using bridge::InputMonitor;

constexpr std::array<double, 2> kPoseSigma{0.3, 0.1};  // of a pose without covariance [m, rad]

GazeNodeConfig readGazeConfig(const ros::NodeHandle& private_node) {
  auto config = bridge::readParameters<GazeNodeConfig>(private_node);
  config.frames = config.frames.withoutSlashes();
  config.gaze.check(private_node.getNamespace());
  return config;
}

HeadCommand toMessage(const motion::HeadCommand& command, const std::string& joint) {
  HeadCommand message;
  message.header.stamp = ros::Time::now();
  message.joint = joint;
  const bool stops = command.mode == motion::HeadCommand::Mode::kStop;
  message.mode = stops ? HeadCommand::STOP : HeadCommand::POSITION;
  message.position = command.position;
  message.rate = command.rate;
  return message;
}

class GazeNode {
 public:
  GazeNode(ros::NodeHandle node, ros::NodeHandle private_node)
      : config_(readGazeConfig(private_node)),
        gaze_(config_.gaze),
        listener_(buffer_, node, false),
        diagnostics_(node, private_node),
        feature_monitor_(node.resolveName("features"), diagnostics_.updater()),
        pose_monitor_(node.resolveName("pose"), diagnostics_.updater()),
        scan_monitor_(node.resolveName(config_.range_scan), diagnostics_.updater()),
        head_monitor_(node.resolveName("joint_states"), diagnostics_.updater()),
        controls_(node, private_node, config_.frames.odom, transforms_, gaze_,
                  diagnostics_.updater()),
        commands_(node.advertise<HeadCommand>("head_command", 10)),
        markers_(node.advertise<visualization_msgs::MarkerArray>("gaze_markers", 5)) {
    if (!config_.map.empty()) gaze_.setMap(world::RoomMap::readFile(config_.map));
    features_subscriber_ = node.subscribe("features", 10, &GazeNode::onFeatures, this);
    pose_subscriber_ = node.subscribe("pose", 10, &GazeNode::onPose, this);
    head_subscriber_ = node.subscribe("joint_states", 100, &GazeNode::onHead, this);
    if (!config_.range_scan.empty()) {
      scan_subscriber_ = node.subscribe(config_.range_scan, 10, &GazeNode::onScan, this);
    }
    timer_ = node.createSteadyTimer(ros::WallDuration(1.0 / config_.rate),
                                    [this](const ros::SteadyTimerEvent&) { decide(); });
  }

 private:
  void onFeatures(const FeatureArray& message) {
    feature_monitor_.use([&] {
      gaze_.takeFeatures(bridge::nanoseconds(message.header.stamp), bridge::fromMessage(message));
    });
  }

  void onPose(const geometry_msgs::PoseWithCovarianceStamped& message) {
    pose_monitor_.use([&] {
      gaze_.takePose(bridge::nanoseconds(message.header.stamp),
                     bridge::readInitialPose(message, config_.frames.map, kPoseSigma));
    });
  }

  void onHead(const sensor_msgs::JointState& message) {
    const auto joint = std::find(message.name.begin(), message.name.end(), config_.joint);
    if (joint == message.name.end()) return;  // of another part of the robot
    head_monitor_.use([&] {
      const auto index = static_cast<std::size_t>(joint - message.name.begin());
      if (index >= message.position.size() || !std::isfinite(message.position[index])) {
        throw bridge::BadMessage("a joint without a position");
      }
      head_angle_ = message.position[index];
      gaze_.takeHead(bridge::nanoseconds(ros::Time::now()), head_angle_);
    });
  }

  void onScan(const RangeScan& message) {
    scan_monitor_.use([&] {
      try {
        take(reader_.read(message));
      } catch (const scan::InvalidScan& fault) {
        throw bridge::BadMessage(fault.what());
      }
    });
  }

  // The motion of the carrier during the sweep moves a wall by less than a stretch of it.
  void take(motion::RangeScan range_scan) {
    const scan::ScanGeometry& geometry = *range_scan.scan.geometry();
    gaze::SensorField field = gaze_.config().field;
    field.centre = 0.5 * (geometry.angles().front() + geometry.angles().back());
    field.half_width = 0.5 * std::abs(geometry.angles().back() - geometry.angles().front());
    field.range_min = geometry.rangeMin();
    field.range_max = geometry.rangeMax();
    field.origin_x = range_scan.head.origin.x();
    field.origin_y = range_scan.head.origin.y();
    gaze_.setField(field);
    range_scan.scan.setSensorMotion(motion::headMotion(range_scan.head));
    gaze_.takeScan(range_scan.scan, range_scan.head.T_mount_sensor(0));
  }

  void lookUpTransforms() {
    const auto T_odom_base = transforms_.newest(config_.frames.odom, config_.frames.base);
    if (T_odom_base && T_odom_base->stamp) {
      gaze_.takeOdometry(*T_odom_base->stamp, geometry::inPlane(T_odom_base->T_target_source));
      T_odom_base_ = geometry::inPlane(T_odom_base->T_target_source);
    }
    const auto mounting = transforms_.newest(config_.frames.base, config_.mount_frame);
    if (!mounting) return;
    T_base_mount_ = geometry::inPlane(mounting->T_target_source);
    gaze_.setMounting(T_base_mount_);
  }

  void decide() {
    const ros::Time now = ros::Time::now();
    if (now.isZero()) return;  // the clock has not begun
    lookUpTransforms();
    if (const auto command = gaze_.decide(bridge::nanoseconds(now))) {
      commands_.publish(toMessage(*command, config_.joint));
    }
    tellTrouble();
    if (markers_.getNumSubscribers() == 0) return;
    std_msgs::Header mount;
    mount.stamp = now;
    mount.frame_id = config_.mount_frame;
    markers_.publish(bridge::gazeMarkers(gaze_, head_angle_, mount, config_.frames.odom,
                                         T_odom_base_ * T_base_mount_));
  }

  void tellTrouble() {
    const std::string& message = gaze_.state().message;
    if (message != trouble_ && !message.empty()) ROS_WARN("gaze: %s", message.c_str());
    trouble_ = message;
  }

  GazeNodeConfig config_;
  gaze::GazeControl gaze_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  bridge::TfTransforms transforms_{buffer_};
  bridge::RangeScanReader reader_;
  bridge::NodeDiagnostics diagnostics_;
  InputMonitor feature_monitor_, pose_monitor_, scan_monitor_, head_monitor_;
  GazeControls controls_;
  ros::Publisher commands_, markers_;
  ros::Subscriber features_subscriber_, pose_subscriber_, head_subscriber_, scan_subscriber_;
  ros::SteadyTimer timer_;
  geometry::Pose2 T_odom_base_, T_base_mount_;
  double head_angle_ = 0.0;
  std::string trouble_;
};

}  // namespace

std::shared_ptr<void> makeGaze(ros::NodeHandle node, ros::NodeHandle private_node) {
  return std::make_shared<GazeNode>(std::move(node), std::move(private_node));
}

}  // namespace sightline::nodes
