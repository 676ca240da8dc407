#include "sightline/bridge/team_input.h"

#include <utility>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/target_messages.h"
#include "sightline/bridge/time.h"

namespace sightline::bridge {

TeamInput::TeamInput(ros::NodeHandle node, pipeline::BearingTopics team,
                     diagnostic_updater::Updater& updater, tf2_ros::Buffer& buffer,
                     pipeline::BearingFeed& feed, After after)
    : team_(std::move(team)), feed_(feed), after_(std::move(after)) {
  if (team_.pose_topic.empty()) listener_.emplace(buffer, node);
  for (const std::string& robot : team_.robots) subscribe(node, robot, updater);
}

void TeamInput::subscribe(ros::NodeHandle& node, const std::string& robot,
                          diagnostic_updater::Updater& updater) {
  constexpr std::uint32_t kQueue = 100;
  const std::string topic = team_.topicOf(robot, team_.bearings_topic);
  monitors_.emplace(robot, std::make_unique<InputMonitor>(topic, updater));
  subscribers_.push_back(node.subscribe<BearingArray>(
      topic, kQueue,
      [this, robot](const BearingArray::ConstPtr& message) { take(robot, *message); },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  if (team_.pose_topic.empty()) return;
  subscribers_.push_back(node.subscribe<PoseMessage>(
      team_.topicOf(robot, team_.pose_topic), kQueue,
      [this, robot](const PoseMessage::ConstPtr& message) { takePose(robot, *message); },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
}

void TeamInput::take(const std::string& robot, const BearingArray& message) {
  monitors_.at(robot)->use([&] {
    feed_.add({robot, withoutSlash(message.header.frame_id), toBearingSet(message),
               nanoseconds(ros::Time::now())});
  });
  after_();
}

void TeamInput::takePose(const std::string& robot, const PoseMessage& message) {
  try {
    feed_.addPose(robot, nanoseconds(message.header.stamp), toUncertainPose2(message));
  } catch (const BadMessage& fault) {
    drop(robot, std::string("pose: ") + fault.what());
  }
  after_();
}

void TeamInput::drop(const std::string& robot, const std::string& reason) {
  monitors_.at(robot)->drop(reason);
}

}  // namespace sightline::bridge
