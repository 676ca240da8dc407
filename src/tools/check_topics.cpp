// Tells in one page what a running robot publishes and what is wrong with it.
#include <cstdio>
#include <list>
#include <string>

#include <ros/ros.h>

#include "program/program.h"
#include "sightline/bridge/recording_check.h"
#include "sightline/bridge/time.h"

namespace {

using namespace sightline;

// Subscriptions to all topics of the types that estimators take.
class Listener {
 public:
  Listener(ros::NodeHandle& node, bridge::RecordingCheck& check) : check_(check) {
    ros::master::V_TopicInfo topics;
    ros::master::getTopics(topics);
    for (const ros::master::TopicInfo& topic : topics) {
      listen<sensor_msgs::LaserScan>(node, topic) ||
          listen<sensor_msgs::MultiEchoLaserScan>(node, topic) ||
          listen<nav_msgs::Odometry>(node, topic) || listen<sensor_msgs::Imu>(node, topic) ||
          listen<tf2_msgs::TFMessage>(node, topic);
    }
  }

 private:
  template <class Message>
  bool listen(ros::NodeHandle& node, const ros::master::TopicInfo& topic) {
    if (topic.datatype != ros::message_traits::datatype<Message>()) return false;
    const boost::function<void(const boost::shared_ptr<const Message>&)> take =
        [this, topic](const boost::shared_ptr<const Message>& message) {
          check_.count(topic.name, topic.datatype);
          offer(topic.name, *message);
        };
    subscribers_.push_back(node.subscribe<Message>(topic.name, 1000, take));
    return true;
  }
  template <class Message>
  void offer(const std::string& topic, const Message& message) {
    check_.take(topic, message, bridge::nanoseconds(ros::Time::now()));
  }
  void offer(const std::string& topic, const tf2_msgs::TFMessage& message) {
    check_.take(topic, message);
  }

  bridge::RecordingCheck& check_;
  std::list<ros::Subscriber> subscribers_;
};

int runCheck(double seconds) {
  if (!ros::master::check()) {
    std::fputs("no ROS master at ROS_MASTER_URI\n", stderr);
    return 1;
  }
  ros::NodeHandle node;
  bridge::RecordingCheck check({});
  const Listener listener(node, check);
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  for (ros::WallRate rate(200.0); ros::ok() && ros::WallTime::now() < end; rate.sleep()) {
    ros::spinOnce();
  }
  const bridge::RecordingReport report = check.report({});
  std::fputs(report.text().c_str(), stdout);
  return report.exitStatus();
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "check_topics", ros::init_options::AnonymousName);
  double seconds = 10.0;
  sightline::tools::Program program(
      "check_topics",
      "Listens to a running robot and tells in one page what is wrong with its scans, frames and "
      "odometry. Ends with status 0 where all is well, 3 with errors, 4 with warnings.");
  program.option("--seconds", seconds, "SECONDS", "how long to listen, 10 by default");
  return program.run(argc, argv, [&] { return runCheck(seconds); });
}
