#include "sightline/bridge/bearing_bags.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <rosbag/view.h>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/bag_feed.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/target_messages.h"
#include "sightline/bridge/time.h"
#include "sightline/config/error.h"

namespace sightline::bridge {

namespace {

// All topics of bags, without leading slashes.
std::set<std::string> topicsOf(const std::deque<rosbag::Bag>& bags) {
  std::set<std::string> topics;
  for (const rosbag::Bag& bag : bags) {
    rosbag::View view(bag);
    for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
      topics.insert(withoutSlash(connection->topic));
    }
  }
  return topics;
}

}  // namespace

BearingBags::BearingBags(const std::vector<std::string>& paths, const pipeline::BearingTopics& team)
    : team_(team) {
  if (team.robots.empty()) throw config::Error("", 0, "targets.robots", "none are named");
  for (const std::string& path : paths) {
    bags_.emplace_back();
    openToRead(bags_.back(), path);
  }
  const std::set<std::string> known = topicsOf(bags_);
  for (const std::string& robot : team.robots) {
    const std::string topic = withoutSlash(team.topicOf(robot, team.bearings_topic));
    if (known.count(topic) == 0) {
      throw config::Error(paths.front(), 0, "", fmt::format("no bearings on /{}", topic));
    }
    bearings_[topic] = robot;
    if (team.pose_topic.empty()) continue;
    poses_[withoutSlash(team.topicOf(robot, team.pose_topic))] = robot;
  }
}

void BearingBags::takeTransforms(const rosbag::MessageInstance& message, bool is_static) {
  const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
  if (!transforms) return;
  const std::int64_t now = nanoseconds(message.getTime());
  for (const std::string& fault : transform_input_.take(*transforms, is_static, now)) {
    ++refused_["tf: " + fault];
  }
}

void BearingBags::take(const rosbag::MessageInstance& message, pipeline::BearingFeed& feed) {
  const std::string topic = withoutSlash(message.getTopic());
  try {
    if (const auto found = bearings_.find(topic); found != bearings_.end()) {
      if (const auto look = message.instantiate<BearingArray>()) {
        feed.add({found->second, withoutSlash(look->header.frame_id), toBearingSet(*look),
                  nanoseconds(message.getTime())});
      }
    } else if (const auto of = poses_.find(topic); of != poses_.end()) {
      const auto pose = message.instantiate<geometry_msgs::PoseWithCovarianceStamped>();
      if (pose) feed.addPose(of->second, nanoseconds(pose->header.stamp), toUncertainPose2(*pose));
    } else {
      takeTransforms(message, topic == "tf_static");
    }
  } catch (const BadMessage& fault) {
    ++refused_[topic + ": " + fault.what()];
  }
}

void BearingBags::read(pipeline::BearingFeed& feed, const After& after) {
  std::vector<std::string> topics{"tf", "/tf", "tf_static", "/tf_static"};
  for (const auto* names : {&bearings_, &poses_}) {
    for (const auto& [topic, robot] : *names) {
      topics.push_back(topic);
      topics.push_back("/" + topic);
    }
  }
  rosbag::View view;
  for (const rosbag::Bag& bag : bags_) view.addQuery(bag, rosbag::TopicQuery(topics));
  const ros::Time begin = view.getBeginTime();
  duration_ = std::max((view.getEndTime() - begin).toSec(), 1e-9);
  for (const rosbag::MessageInstance& message : view) {
    take(message, feed);
    after(message.getTime(), (message.getTime() - begin).toSec() / duration_);
  }
  after(view.getEndTime() + ros::Duration(team_.patience + 1.0), 1.0);
}

}  // namespace sightline::bridge
