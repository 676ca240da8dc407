#pragma once

#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include <sightline/BearingArray.h>
#include <sightline/TargetArray.h>
#include "bench/live_node.h"
#include "figures.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/target_messages.h"
#include "sightline/targets/simulated_team.h"

namespace sightline::bench {

/// A simulated team whose looks and poses go to a running target_tracker.
class LiveTeam {
 public:
  explicit LiveTeam(const targets::TeamConfig& config) : team_(config, 1) {
    for (int i = 1; i <= config.robots; ++i) {
      const std::string robot = fmt::format("robot{}", i);
      looks_.push_back(node_.advertise<BearingArray>(robot + "/bearings", 10));
      poses_.push_back(
          node_.advertise<geometry_msgs::PoseWithCovarianceStamped>(robot + "/pose", 10));
    }
    const boost::function<void(const TargetArray::ConstPtr&)> receive =
        [this](const TargetArray::ConstPtr& answer) { take(*answer); };
    answers_ = node_.subscribe<TargetArray>("targets", 10, receive, {},
                                            ros::TransportHints().tcpNoDelay());
  }

  bool isConnected() const {
    for (const auto& publisher : looks_) {
      if (publisher.getNumSubscribers() == 0) return false;
    }
    return answers_.getNumPublishers() > 0;
  }

  /// One look of each robot, a little apart so that each answer is of one of them.
  void look() {
    for (auto& simulated : team_.step()) {
      const std::size_t robot = simulated.set.robot;
      const ros::Time stamp = ros::Time::now();
      simulated.set.stamp = static_cast<std::int64_t>(stamp.toNSec());
      geometry_msgs::PoseWithCovarianceStamped pose;
      pose.header.stamp = stamp;
      pose.header.frame_id = "map";
      pose.pose.pose = bridge::toPose(simulated.set.T_map_sensor.mean);
      poses_[robot].publish(pose);
      sent_[stamp] = Clock::now();
      looks_[robot].publish(bridge::toMessage(simulated.set, fmt::format("laser{}", robot)));
    }
  }
  const std::vector<double>& latencies() const { return latencies_ms_; }

 private:
  using Clock = std::chrono::steady_clock;

  void take(const TargetArray& answer) {
    const auto found = sent_.find(answer.header.stamp);
    if (found == sent_.end()) return;
    const std::chrono::duration<double, std::milli> latency = Clock::now() - found->second;
    latencies_ms_.push_back(latency.count());
  }

  targets::SimulatedTeam team_;
  ros::NodeHandle node_;
  std::vector<ros::Publisher> looks_;
  std::vector<ros::Publisher> poses_;
  ros::Subscriber answers_;
  std::map<ros::Time, Clock::time_point> sent_;
  std::vector<double> latencies_ms_;
};

/// Load of the node with three robots at 10 Hz.
inline void measureTrackerNode(double seconds) {
  using Clock = std::chrono::steady_clock;
  const Master master;
  const Process node({SIGHTLINE_PROGRAMS "/target_tracker", "_robots:=robot1 robot2 robot3",
                      "_bernoulli/undetected/area:=[0.0, 0.0, 20.0, 20.0]"});
  targets::TeamConfig config;
  config.period = 0.1;
  LiveTeam team(config);
  const auto patience = Clock::now() + std::chrono::seconds(20);
  while (!team.isConnected()) {
    if (Clock::now() > patience) throw std::runtime_error("target_tracker does not answer");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ros::spinOnce();
  }
  const double cpu_before = node.cpuSeconds();
  const auto began = Clock::now();
  for (int i = 0; i < static_cast<int>(seconds / config.period); ++i) {
    const auto due = began + std::chrono::milliseconds(100 * i);
    while (Clock::now() < due) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.0005));
    }
    team.look();
  }
  const std::chrono::duration<double> took = Clock::now() - began;
  print("targets.node.cpu_percent", 100.0 * (node.cpuSeconds() - cpu_before) / took.count(), "%");
  print("targets.node.latency_p99_ms", quantile(team.latencies(), 0.99), "ms");
}

}  // namespace sightline::bench
