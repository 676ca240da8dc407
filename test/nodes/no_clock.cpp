// Diagnostics and warnings of the nodes while simulated time does what it should not.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <rosgraph_msgs/Log.h>

#include "nodes/diagnostics.h"
#include "nodes/recorder.h"

namespace sightline {
namespace {

using test::comesTrue;
using test::Recorder;

bool isTold(const Recorder<rosgraph_msgs::Log>& logs, const std::string& node,
            const std::string& text) {
  const auto all = logs.all();
  return std::any_of(all.begin(), all.end(), [&](const rosgraph_msgs::Log& log) {
    return log.name == node && log.msg.find(text) != std::string::npos;
  });
}

TEST(NoClock, IsNamedByEveryNode) {
  Recorder<rosgraph_msgs::Log> logs("/rosout");
  const test::Diagnostics diagnostics;
  for (const std::string node : {"/room_tracker", "/laser_odometry"}) {
    EXPECT_TRUE(comesTrue([&] { return isTold(logs, node, "nobody publishes /clock"); })) << node;
    const std::string part = node.substr(1) + ": clock";
    EXPECT_TRUE(comesTrue([&] {
      return diagnostics.text(part).find("nobody publishes /clock") != std::string::npos;
    })) << diagnostics.text(part);
  }
}

TEST(NoClock, DiagnosticsGoOnFromZeroAndAfterItIsSetBack) {
  ros::NodeHandle node;
  const ros::Publisher clock = node.advertise<rosgraph_msgs::Clock>("/clock", 10);
  Recorder<diagnostic_msgs::DiagnosticArray> arrays("/diagnostics");
  const test::Diagnostics diagnostics;
  for (const double start : {0.0, 50.0, 1.0}) {
    double time = start;
    const std::size_t before = arrays.count();
    const auto tick = [&] {
      rosgraph_msgs::Clock message;
      message.clock = ros::Time(time += 0.05);
      clock.publish(message);
    };
    EXPECT_TRUE(comesTrue([&] { return arrays.count() >= before + 6; }, tick)) << start;
  }
  diagnostics.expectValue("room_tracker: input /scan", "used", "0");
}

}  // namespace
}  // namespace sightline
