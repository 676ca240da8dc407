// The node gaze before a simulated sensor: features come, are fixated, and refused where they are
// not there.
#include <cmath>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/Trigger.h>

#include <sightline/FeatureArray.h>
#include <sightline/Fixate.h>
#include "nodes/comes_true.h"
#include "nodes/diagnostics.h"
#include "nodes/recorder.h"

namespace sightline {
namespace {

class GazeNodeTest : public testing::Test {
 protected:
  Fixate::Response fixate(const Fixate::Request& request) {
    Fixate fixation;
    fixation.request = request;
    EXPECT_TRUE(ros::service::waitForService("/gaze/fixate", 20000));
    EXPECT_TRUE(ros::service::call("/gaze/fixate", fixation));
    return fixation.response;
  }
  void call(const std::string& service) {
    std_srvs::Trigger trigger;
    EXPECT_TRUE(ros::service::call("/gaze/" + service, trigger));
    EXPECT_TRUE(trigger.response.success);
  }
  double headAngle() { return joints_.next().position.at(0); }
  // The apex of the edge, once it is known.
  Feature apex() {
    Feature found;
    EXPECT_TRUE(test::comesTrue([&] {
      for (const Feature& feature : features_.next().features) {
        if (feature.kind != Feature::CORNER || feature.sightings < 5) continue;
        found = feature;
        return true;
      }
      return false;
    }));
    return found;
  }

  test::Recorder<FeatureArray> features_{"features"};
  test::Recorder<sensor_msgs::JointState> joints_{"joint_states"};
  test::Diagnostics diagnostics_;
};

TEST_F(GazeNodeTest, FixatesACornerByItsId) {
  const Feature corner = apex();
  EXPECT_EQ(features_.all().back().header.frame_id, "odom");
  Fixate::Request request;
  request.id = corner.id;
  const auto response = fixate(request);
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.id, corner.id);
  // The head's axis is 0.1 m ahead of the robot, the beams start beside it.
  const double bearing = std::atan2(corner.position.y, corner.position.x - 0.1);
  EXPECT_TRUE(test::comesTrue([&] { return std::abs(headAngle() - bearing) < 0.06; }));
  diagnostics_.expectValue("gaze: gaze", "mode", "fixate");
}

TEST_F(GazeNodeTest, RefusesWhatIsNotThere) {
  apex();
  Fixate::Request request;
  request.id = 100000;
  EXPECT_EQ(fixate(request).message, "there is no feature 100000");
  request.rule = Fixate::Request::AT_POINT;
  request.point.header.frame_id = "odom";
  request.point.point.x = -5.0;
  EXPECT_FALSE(fixate(request).success);
  request.point.header.frame_id = "nowhere";
  EXPECT_NE(fixate(request).message.find("no transform from 'nowhere'"), std::string::npos);
  request.point.point.x = std::nan("");
  EXPECT_EQ(fixate(request).message, "a point that is not finite");
  request.rule = 77;
  EXPECT_EQ(fixate(request).message, "there is no such rule");
}

TEST_F(GazeNodeTest, SweepsAndHolds) {
  call("sweep");
  EXPECT_TRUE(test::comesTrue([&] { return std::abs(headAngle()) > 1.0; }));
  call("hold");
  diagnostics_.expectValue("gaze: gaze", "mode", "hold");
}

TEST_F(GazeNodeTest, RestsWhereItHasNoMap) {
  call("inform");
  EXPECT_TRUE(test::comesTrue([&] { return diagnostics_.text("gaze: gaze") == "no map"; }));
  EXPECT_TRUE(test::comesTrue([&] { return std::abs(headAngle()) < 1e-3; }));
  call("hold");
}

}  // namespace
}  // namespace sightline
