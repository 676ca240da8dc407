// Tells a running graph the transforms of recordings that never change, before they are played.
#include <map>
#include <string>
#include <vector>

#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include "program/program.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/config/error.h"

namespace {

using namespace sightline;

const std::vector<std::string> kTopics{"/tf_static", "tf_static"};

void addTransforms(const std::string& path,
                   std::map<std::string, geometry_msgs::TransformStamped>& by_child) {
  try {
    const rosbag::Bag bag(path);
    rosbag::View view(bag, rosbag::TopicQuery(kTopics));
    for (const rosbag::MessageInstance& instance : view) {
      const auto message = instance.instantiate<tf2_msgs::TFMessage>();
      if (!message) continue;
      for (auto transform : message->transforms) {
        transform.header.frame_id = bridge::withoutSlash(transform.header.frame_id);
        transform.child_frame_id = bridge::withoutSlash(transform.child_frame_id);
        by_child[transform.child_frame_id] = transform;
      }
    }
  } catch (const rosbag::BagException& fault) {
    throw config::Error(path, 0, "", fault.what());
  }
}

int publish(const std::vector<std::string>& bags) {
  std::map<std::string, geometry_msgs::TransformStamped> by_child;
  for (const std::string& bag : bags) addTransforms(bag, by_child);
  tf2_msgs::TFMessage message;
  for (const auto& [child, transform] : by_child) message.transforms.push_back(transform);
  ros::NodeHandle node;
  const auto publisher = node.advertise<tf2_msgs::TFMessage>("/tf_static", 100, /*latch=*/true);
  if (!message.transforms.empty()) publisher.publish(message);
  ros::spin();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "static_transforms");
  std::vector<std::string> bags;
  tools::Program program("static_transforms",
                         "Publishes the /tf_static of recordings, latched: a player that does not\n"
                         "begin at the start leaves it out. Runs until ROS is shut down.");
  program.positionals("IN.bag", bags, "the bags to read");
  return program.run(argc, argv, [&] { return publish(bags); });
}
