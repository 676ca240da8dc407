#include "sightline/bridge/recorded_targets.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <rosbag/view.h>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/bag_feed.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/config/error.h"

namespace sightline::bridge {

namespace {

std::string inFolder(const std::string& folder, const char* name) {
  return (std::filesystem::path(folder) / name).string();
}

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

RecordedTargets::RecordedTargets(const std::vector<std::string>& paths,
                                 const pipeline::TargetsConfig& config, const std::string& folder)
    : config_(config),
      log_(inFolder(folder, "targets.csv")),
      output_(bag_output_, config, transforms_) {
  if (config.robots.empty()) throw config::Error("", 0, "targets.robots", "none are named");
  for (const std::string& path : paths) {
    bags_.emplace_back();
    openToRead(bags_.back(), path);
  }
  const std::set<std::string> known = topicsOf(bags_);
  for (const std::string& robot : config.robots) {
    const std::string topic = withoutSlash(config.topicOf(robot, config.bearings_topic));
    if (known.count(topic) == 0) {
      throw config::Error(paths.front(), 0, "", fmt::format("no bearings on /{}", topic));
    }
    bearings_[topic] = robot;
    if (!config.pose_topic.empty()) {
      poses_[withoutSlash(config.topicOf(robot, config.pose_topic))] = robot;
    }
  }
  output_.listener = [this](const targets::TargetEstimate& estimate) { log_.add(estimate); };
  out_.open(inFolder(folder, "out.bag"), rosbag::bagmode::Write);
}

void RecordedTargets::refuse(const std::string& topic, const std::string& reason) {
  ++refused_[topic + ": " + reason];
}

void RecordedTargets::takeLook(const std::string& robot, const BearingArray& message) {
  output_.feed().add(
      {robot, withoutSlash(message.header.frame_id), toBearingSet(message), nanoseconds(now_)});
}

void RecordedTargets::take(const rosbag::MessageInstance& message) {
  const std::string topic = withoutSlash(message.getTopic());
  try {
    if (const auto found = bearings_.find(topic); found != bearings_.end()) {
      if (const auto look = message.instantiate<BearingArray>()) takeLook(found->second, *look);
    } else if (const auto of = poses_.find(topic); of != poses_.end()) {
      const auto pose = message.instantiate<geometry_msgs::PoseWithCovarianceStamped>();
      if (pose) {
        output_.feed().addPose(of->second, nanoseconds(pose->header.stamp),
                               toUncertainPose2(*pose));
      }
    } else if (const auto transforms = message.instantiate<tf2_msgs::TFMessage>()) {
      for (const std::string& fault :
           transform_input_.take(*transforms, topic == "tf_static", nanoseconds(now_))) {
        refuse(topic, fault);
      }
    }
  } catch (const BadMessage& fault) {
    refuse(topic, fault.what());
  }
}

void RecordedTargets::read(const std::function<void(double)>& progress) {
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
  duration_ = (view.getEndTime() - begin).toSec();
  for (const rosbag::MessageInstance& message : view) {
    now_ = message.getTime();
    take(message);
    output_.run(nanoseconds(now_));
    progress((now_ - begin).toSec() / std::max(duration_, 1e-9));
  }
  // Nothing more can come: what still waits has waited long enough.
  output_.run(nanoseconds(now_) + std::llround(1e9 * (config_.patience + 1.0)));
  log_.close();
  out_.close();
}

std::vector<std::string> RecordedTargets::summary() const {
  std::vector<std::string> lines = output_.summary();
  for (const auto& [reason, count] : refused_) {
    lines.push_back(fmt::format("{} messages left out: {}", count, reason));
  }
  return lines;
}

}  // namespace sightline::bridge
