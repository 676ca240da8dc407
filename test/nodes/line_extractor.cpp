#include <cmath>
#include <limits>
#include <string>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <sys/wait.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include "nodes/recorder.h"
#include "sightline/LineSegmentArray.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/geometry/angle.h"

namespace sightline {
namespace {

using test::Recorder;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A wall two metres ahead, seen by a scanner that stands still or turns on the spot while it scans.
sensor_msgs::LaserScan wallAhead(const ros::Time& stamp, double turn = 0.0) {
  constexpr int kBeams = 361;
  sensor_msgs::LaserScan scan;
  scan.header.stamp = stamp;
  scan.header.frame_id = "laser";
  scan.angle_min = static_cast<float>(-0.25 * geometry::kPi);
  scan.angle_increment = static_cast<float>(0.5 * geometry::kPi / (kBeams - 1));
  scan.angle_max = -scan.angle_min;
  scan.time_increment = 0.1F / (kBeams - 1);
  scan.range_min = 0.1F;
  scan.range_max = 30.0F;
  for (int i = 0; i < kBeams; ++i) {
    const double share = static_cast<double>(i) / (kBeams - 1);
    const double angle = scan.angle_min + i * scan.angle_increment + share * turn;
    // A little roughness: nothing real is as straight as rounding.
    scan.ranges.push_back(static_cast<float>(2.0 / std::cos(angle) + 0.01 * std::sin(7.0 * i)));
  }
  return scan;
}

class LineExtractorNode : public ::testing::Test {
 protected:
  explicit LineExtractorNode(const std::string& prefix = "")
      : publisher_(node_.advertise<sensor_msgs::LaserScan>(prefix + "scan", 100)),
        lines_(prefix + "lines"),
        markers_(prefix + "line_markers") {
    while (ros::ok() && publisher_.getNumSubscribers() < 1) ros::WallDuration(0.02).sleep();
    // The node has connected to the recorders too once an answer has come.
    while (ros::ok() && (lines_.count() == 0 || markers_.count() == 0)) {
      publisher_.publish(wallAhead(ros::Time::now()));
      ros::WallDuration(0.1).sleep();
    }
    ros::WallDuration(0.3).sleep();
  }

  // All that has come since the last call, after the node has had time to answer.
  std::vector<LineSegmentArray> answers() {
    ros::WallDuration(0.7).sleep();
    const auto all = lines_.all();
    const std::vector<LineSegmentArray> fresh(all.begin() + static_cast<long>(seen_), all.end());
    seen_ = all.size();
    return fresh;
  }

  ros::NodeHandle node_;
  ros::Publisher publisher_;
  Recorder<LineSegmentArray> lines_;
  Recorder<visualization_msgs::MarkerArray> markers_;
  std::size_t seen_ = 0;
};

TEST_F(LineExtractorNode, AnswersEveryScanOnceWithItsStampAndFrame) {
  answers();
  std::vector<ros::Time> stamps;
  for (int i = 0; i < 20; ++i) {
    // A stamp in the past is as good as any: lines do not depend on what was before.
    stamps.push_back(ros::Time(1000 + (i == 10 ? 1 : i), 123456789));
    publisher_.publish(wallAhead(stamps.back()));
    ros::WallDuration(0.01).sleep();
  }
  const auto arrays = answers();
  ASSERT_EQ(arrays.size(), stamps.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    EXPECT_EQ(arrays[i].header.stamp, stamps[i]);
    EXPECT_EQ(arrays[i].header.frame_id, "laser");
    ASSERT_EQ(arrays[i].segments.size(), 1U);
    EXPECT_NEAR(arrays[i].segments[0].rho, 2.0, 0.01);
    EXPECT_NEAR(arrays[i].segments[0].phi, 0.0, 0.005);
  }
}

TEST_F(LineExtractorNode, AnswersAnEmptyWorldWithAnEmptyArray) {
  answers();
  auto scan = wallAhead(ros::Time(2000, 5));
  for (float& range : scan.ranges) range = std::numeric_limits<float>::infinity();
  publisher_.publish(scan);
  const auto arrays = answers();
  ASSERT_EQ(arrays.size(), 1U);
  EXPECT_TRUE(arrays[0].segments.empty());
  EXPECT_EQ(arrays[0].header.stamp, ros::Time(2000, 5));
  EXPECT_EQ(arrays[0].header.frame_id, "laser");
  for (const auto& marker : markers_.all().back().markers) {
    EXPECT_EQ(marker.action, visualization_msgs::Marker::DELETE);
  }
}

TEST_F(LineExtractorNode, BadScansAreDroppedAndCounted) {
  Recorder<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  answers();
  const ros::Time now = ros::Time::now();
  auto no_beams = wallAhead(now);
  no_beams.ranges.clear();
  auto no_increment = wallAhead(now);
  no_increment.angle_increment = 0.0F;
  auto nan_increment = wallAhead(now);
  nan_increment.angle_increment = kNan;
  auto intensities = wallAhead(now);
  intensities.intensities.resize(3);
  const auto no_stamp = wallAhead(ros::Time());
  for (const auto& bad : {no_beams, no_increment, nan_increment, intensities, no_stamp}) {
    publisher_.publish(bad);
    publisher_.publish(wallAhead(now));
  }
  EXPECT_EQ(answers().size(), 5U) << "the good ones";
  const auto dropped = [&] {
    std::string count = "0";
    for (const auto& array : diagnostics.all()) {
      for (const auto& status : array.status) {
        if (status.name != "line_extractor: input /scan") continue;
        for (const auto& value : status.values) {
          if (value.key == "dropped") count = value.value;
        }
      }
    }
    return std::stoi(count);
  };
  for (int i = 0; i < 200 && dropped() < 5; ++i) ros::WallDuration(0.05).sleep();
  EXPECT_EQ(dropped(), 5);
}

TEST_F(LineExtractorNode, SingleBadReturnsAreSkipped) {
  answers();
  auto scan = wallAhead(ros::Time::now());
  for (std::size_t i = 5; i < scan.ranges.size(); i += 17) {
    scan.ranges[i] = i % 3 == 0 ? kNan : i % 3 == 1 ? 0.0F : -1.0F;
  }
  publisher_.publish(scan);
  const auto arrays = answers();
  ASSERT_EQ(arrays.size(), 1U);
  EXPECT_EQ(arrays[0].segments.size(), 1U);
}

TEST_F(LineExtractorNode, SettingsCanBeChangedWhileItRuns) {
  const auto set = [](double min_length) {
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::DoubleParameter parameter;
    parameter.name = "min_length";
    parameter.value = min_length;
    call.request.config.doubles.push_back(parameter);
    EXPECT_TRUE(ros::service::call("line_extractor/lines/set_parameters", call));
  };
  answers();
  set(5.0);
  publisher_.publish(wallAhead(ros::Time::now()));
  const auto none = answers();
  set(0.5);
  publisher_.publish(wallAhead(ros::Time::now()));
  const auto one = answers();
  ASSERT_EQ(none.size(), 1U);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(none[0].segments.size(), 0U);
  EXPECT_EQ(one[0].segments.size(), 1U);
}

class NodeletOfLines : public LineExtractorNode {
 protected:
  NodeletOfLines() : LineExtractorNode("nodelets/") {}
};

TEST_F(NodeletOfLines, AnswersAsTheNodeDoes) {
  answers();
  publisher_.publish(wallAhead(ros::Time(3000, 1)));
  const auto arrays = answers();
  ASSERT_EQ(arrays.size(), 1U);
  EXPECT_EQ(arrays[0].header.stamp, ros::Time(3000, 1));
  EXPECT_EQ(arrays[0].segments.size(), 1U);
}

// The scanner turns by 0.1 rad in the 0.1 s of a sweep; odom says so.
class LinesInMotion : public LineExtractorNode {
 protected:
  LinesInMotion() : LineExtractorNode("moving/") {
    ros::WallDuration(1.0).sleep();  // for the broadcaster to be connected
  }

  void sendOdometry(const ros::Time& stamp, double heading) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stamp;
    transform.header.frame_id = "odom";
    transform.child_frame_id = "laser";
    transform.transform = bridge::toTransform({3.0, -1.0, heading});
    broadcaster_.sendTransform(transform);
  }

  // Odometry from a second before `stamp` to `reach` after it.
  void turn(const ros::Time& stamp, double reach) {
    for (double t = -1.0; t <= reach + 1e-6; t += 0.02) {
      sendOdometry(stamp + ros::Duration(t), 0.7 + t);
    }
    ros::WallDuration(0.3).sleep();
  }

  tf2_ros::TransformBroadcaster broadcaster_;
};

TEST_F(LinesInMotion, ALineHoldsAtTheStampWhateverTheSweep) {
  const ros::Time stamp = ros::Time::now();
  turn(stamp, 0.2);
  answers();
  publisher_.publish(wallAhead(stamp, 0.1));
  const auto arrays = answers();
  ASSERT_EQ(arrays.size(), 1U);
  ASSERT_EQ(arrays[0].segments.size(), 1U);
  EXPECT_NEAR(arrays[0].segments[0].rho, 2.0, 0.01);
  EXPECT_NEAR(arrays[0].segments[0].phi, 0.0, 0.005);
}

TEST_F(LinesInMotion, TheMotionOfAMomentAgoServesWhereOdometryLags) {
  const ros::Time stamp = ros::Time::now() + ros::Duration(10.0);
  turn(stamp, -0.1);
  answers();
  publisher_.publish(wallAhead(stamp, 0.1));
  const auto arrays = answers();
  ASSERT_EQ(arrays.size(), 1U);
  ASSERT_EQ(arrays[0].segments.size(), 1U);
  EXPECT_NEAR(arrays[0].segments[0].phi, 0.0, 0.005) << "the motion of a moment ago serves";
}

TEST_F(LinesInMotion, WithoutOdometryEveryScanIsAnsweredAllTheSame) {
  answers();
  publisher_.publish(wallAhead(ros::Time::now() + ros::Duration(100.0)));
  EXPECT_EQ(answers().size(), 1U);
}

// Ends of a node that is given nonsense.
int statusOf(const std::string& arguments) {
  const int status = std::system(
      ("rosrun sightline line_extractor __name:=bad " + arguments + " > /dev/null 2>&1").c_str());
  return WEXITSTATUS(status);
}

TEST(LineExtractorParameters, OutOfRangeOrOfTheWrongTypeEndTheNode) {
  EXPECT_EQ(statusOf("_lines/gate:=0"), 1);
  ros::param::del("/bad");
  EXPECT_EQ(statusOf("_lines/gate:=wide"), 1);
  ros::param::del("/bad");
  EXPECT_EQ(statusOf("_noise/kind:=white"), 1);
}

}  // namespace
}  // namespace sightline
