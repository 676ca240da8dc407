#include "sightline/pipeline/bearing_topics.h"

namespace sightline::pipeline {

void BearingTopics::visit(config::FieldVisitor& visitor) {
  visitor.texts("robots", robots, "namespaces of the robots; must be set");
  visitor.text("bearings_topic", bearings_topic,
               "topic of sightline/BearingArray in the namespace of each robot");
  visitor.text("pose_topic", pose_topic,
               "topic of geometry_msgs/PoseWithCovarianceStamped, the sensor's pose in the map; "
               "empty: transforms from map_frame to the frame of the bearings tell");
  visitor.text("map_frame", map_frame, "frame of the poses, and of what is found");
  visitor.number("patience", patience,
                 {"s", {0.0, 60.0}, "time that a look waits for the pose of its sensor"});
}

std::string BearingTopics::topicOf(const std::string& robot, const std::string& name) const {
  return robot.empty() ? name : robot + "/" + name;
}

}  // namespace sightline::pipeline
