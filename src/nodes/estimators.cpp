#include <memory>
#include <string>
#include <vector>

#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "nodes/laser_odometry_config.h"
#include "nodes/line_extractor_config.h"
#include "nodes/room_tracker_config.h"
#include "sightline/bridge/mountings.h"
#include "sightline/bridge/parameter_writer.h"
#include "sightline/pipeline/offline_config.h"

namespace sightline::nodes {

std::shared_ptr<void> makeLineExtractor(ros::NodeHandle node, ros::NodeHandle private_node);
std::shared_ptr<void> makeRoomTracker(ros::NodeHandle node, ros::NodeHandle private_node);
std::shared_ptr<void> makeLaserOdometry(ros::NodeHandle node, ros::NodeHandle private_node);

namespace {

/// The estimators that a configuration file asks for, live: the file is the one that `offline`
/// takes. A line extractor for every scan topic (their topics lie below the scan's name where there
/// are several), the room tracker where there is a rooms file, and the laser odometry, of the first
/// scanner, where there is something said about it.
class EstimatorsNode {
 public:
  explicit EstimatorsNode(const pipeline::OfflineConfig& config);

 private:
  void addLineExtractor(const pipeline::OfflineConfig& config, const std::string& scan);
  void addRoomTracker(const pipeline::OfflineConfig& config);
  void addLaserOdometry(const pipeline::OfflineConfig& config);

  tf2_ros::StaticTransformBroadcaster broadcaster_;
  std::vector<std::shared_ptr<void>> estimators_;
};

EstimatorsNode::EstimatorsNode(const pipeline::OfflineConfig& config) {
  broadcaster_.sendTransform(bridge::mountingTransforms(config).transforms);
  for (const std::string& scan : config.scans) addLineExtractor(config, scan);
  if (config.rooms) addRoomTracker(config);
  if (config.odometry) addLaserOdometry(config);
}

void EstimatorsNode::addLineExtractor(const pipeline::OfflineConfig& config,
                                      const std::string& scan) {
  const ros::NodeHandle outside;
  const std::string inside = config.scans.size() > 1 ? outside.resolveName(scan) : "";
  LineExtractorNodeConfig parameters;
  parameters.noise = config.noise;
  parameters.lines = config.lines;
  const ros::NodeHandle node(inside,
                             {{ros::names::append(inside, "scan"), outside.resolveName(scan)}});
  const ros::NodeHandle private_node(node, "line_extractor");
  bridge::writeParameters(private_node, parameters);
  estimators_.push_back(makeLineExtractor(node, private_node));
}

void EstimatorsNode::addRoomTracker(const pipeline::OfflineConfig& config) {
  RoomTrackerNodeConfig parameters;
  parameters.rooms = config.rooms->map;
  parameters.scans.clear();
  for (const std::string& scan : config.scans) parameters.scans += " " + scan;
  parameters.map_frame = config.frames.map;
  parameters.odom_frame = config.frames.odom;
  parameters.base_frame = config.frames.base;
  parameters.initial_pose = config.rooms->initial_pose;
  parameters.initial_sigma = config.rooms->initial_sigma;
  parameters.noise = config.noise;
  parameters.tracker = config.rooms->tracker;
  const ros::NodeHandle private_node("room_tracker");
  bridge::writeParameters(private_node, parameters);
  estimators_.push_back(makeRoomTracker(ros::NodeHandle(), private_node));
}

void EstimatorsNode::addLaserOdometry(const pipeline::OfflineConfig& config) {
  LaserOdometryNodeConfig parameters;
  parameters.odom_frame = config.frames.odom;
  parameters.base_frame = config.frames.base;
  parameters.noise = config.noise;
  parameters.odometry = *config.odometry;
  const ros::NodeHandle outside;
  const ros::NodeHandle node(
      "", {{outside.resolveName("scan"), outside.resolveName(config.scans.front())}});
  const ros::NodeHandle private_node("laser_odometry");
  bridge::writeParameters(private_node, parameters);
  estimators_.push_back(makeLaserOdometry(node, private_node));
}

}  // namespace

std::shared_ptr<void> makeEstimators(ros::NodeHandle, ros::NodeHandle private_node) {
  const auto path = private_node.param<std::string>("config", "");
  if (path.empty()) {
    throw config::Error(private_node.getNamespace(), 0, "config",
                        "has to name a configuration file");
  }
  return std::make_shared<EstimatorsNode>(pipeline::OfflineConfig::readFile(path));
}

}  // namespace sightline::nodes
