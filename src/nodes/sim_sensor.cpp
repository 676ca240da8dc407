#include <memory>

#include <ros/node_handle.h>

namespace sightline::nodes {

std::shared_ptr<void> makeSimSensor(ros::NodeHandle, ros::NodeHandle) {
  return nullptr;
}

}  // namespace sightline::nodes
