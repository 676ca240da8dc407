#include "sightline/bridge/missing_input.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ros/console.h>
#include <ros/master.h>

namespace sightline::bridge {

std::string adviceOn(const std::string& topic, const std::string& type,
                     const std::vector<std::string>& others) {
  if (others.empty()) return fmt::format("nobody publishes {}; rostopic info {}", type, topic);
  return fmt::format("{} is on {}: name it, scan:={} for launch files", type,
                     fmt::join(others, ", "), others.front());
}

std::vector<std::string> MissingInput::others() const {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  std::vector<std::string> names;
  for (const auto& info : topics) {
    if (info.datatype == type_ && info.name != topic_) names.push_back(info.name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

void MissingInput::update(State state) {
  if (type_.empty()) return;
  if (state == State::kComes) {
    if (state_ != State::kComes) ROS_INFO("%s: messages come", topic_.c_str());
    said_.clear();
  } else {
    const char* what = state == State::kCeased ? "no message any more" : "no message yet";
    const std::string text = std::string(what) + "; " + adviceOn(topic_, type_, others());
    if (text != said_) ROS_WARN("%s: %s", topic_.c_str(), text.c_str());
    said_ = text;
  }
  state_ = state;
}

}  // namespace sightline::bridge
