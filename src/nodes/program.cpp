#include "nodes/program.h"

#include <exception>

#include <ros/ros.h>

namespace sightline::nodes {

int runNode(int argc, char** argv, const char* name, MakeNode make) {
  ros::init(argc, argv, name);
  const ros::NodeHandle
      keeps_log_open;  // ROS goes down with its last handle, before the fault is told
  try {
    const auto node = make(ros::NodeHandle(), ros::NodeHandle("~"));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace sightline::nodes
