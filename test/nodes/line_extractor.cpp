#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <dynamic_reconfigure/Reconfigure.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include "nodes/comes_true.h"
#include "nodes/connections.h"
#include "nodes/diagnostics.h"
#include "nodes/recorder.h"
#include "nodes/refusal.h"
#include "sightline/LineSegmentArray.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/geometry/angle.h"

namespace sightline {
namespace {

using test::comesTrue;
using test::Recorder;
using test::refusalOf;
using testing::HasSubstr;

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
    // A little noise, another one in each scan: nothing real is as straight as rounding, and only a
    // driver that has gone silent repeats its ranges.
    const double noise = 0.01 * std::sin(7.0 * i + stamp.nsec);
    scan.ranges.push_back(static_cast<float>(2.0 / std::cos(angle) + noise));
  }
  return scan;
}

class LineExtractorNode : public ::testing::Test {
 protected:
  explicit LineExtractorNode(const std::string& prefix = "")
      : publisher_(node_.advertise<sensor_msgs::LaserScan>(prefix + "scan", 100)),
        lines_(prefix + "lines"),
        markers_(prefix + "line_markers") {
    // The node has connected to the recorders too once an answer has come.
    EXPECT_TRUE(comesTrue([&] { return lines_.count() > 0 && markers_.count() > 0; },
                          [&] { publisher_.publish(wallAhead(ros::Time::now())); }));
    answersTo({});
  }

  // A scan behind them tells when all are answered, as a node answers in order.
  std::vector<LineSegmentArray> answersTo(const std::vector<sensor_msgs::LaserScan>& scans) {
    ros::Time last = scans.empty() ? ros::Time::now() : ros::Time();
    for (const auto& scan : scans) {
      last = std::max(last, scan.header.stamp);
      publisher_.publish(scan);
    }
    const auto closing = wallAhead(last + ros::Duration(0, 1));
    publisher_.publish(closing);
    const auto isLast = [&](const auto& array) {
      return array.header.stamp == closing.header.stamp;
    };
    std::vector<LineSegmentArray> all;
    EXPECT_TRUE(comesTrue([&] {
      all = lines_.all();
      return !all.empty() && isLast(all.back());
    }));
    const auto first = all.begin() + static_cast<long>(std::min(seen_, all.size()));
    seen_ = all.size();
    return {first, all.empty() ? all.end() : std::prev(all.end())};
  }

  std::vector<visualization_msgs::Marker> markersOf(const ros::Time& stamp) const {
    for (const auto& array : markers_.all()) {
      if (!array.markers.empty() && array.markers[0].header.stamp == stamp) return array.markers;
    }
    return {};
  }

  ros::NodeHandle node_;
  ros::Publisher publisher_;
  Recorder<LineSegmentArray> lines_;
  Recorder<visualization_msgs::MarkerArray> markers_;
  std::size_t seen_ = 0;
};

TEST_F(LineExtractorNode, AnswersEveryScanOnceWithItsStampAndFrame) {
  std::vector<sensor_msgs::LaserScan> scans;
  const ros::Time now = ros::Time::now();
  for (int i = 1; i <= 20; ++i) scans.push_back(wallAhead(now + ros::Duration(0.01 * i)));
  const auto arrays = answersTo(scans);
  ASSERT_EQ(arrays.size(), scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(arrays[i].header.stamp, scans[i].header.stamp);
    EXPECT_EQ(arrays[i].header.frame_id, "laser");
    ASSERT_EQ(arrays[i].segments.size(), 1U);
    EXPECT_NEAR(arrays[i].segments[0].rho, 2.0, 0.01);
    EXPECT_NEAR(arrays[i].segments[0].phi, 0.0, 0.005);
  }
}

TEST_F(LineExtractorNode, AnswersAnEmptyWorldWithAnEmptyArray) {
  const ros::Time now = ros::Time::now();
  auto scan = wallAhead(now);
  for (float& range : scan.ranges) range = std::numeric_limits<float>::infinity();
  const auto arrays = answersTo({scan});
  ASSERT_EQ(arrays.size(), 1U);
  EXPECT_TRUE(arrays[0].segments.empty());
  EXPECT_EQ(arrays[0].header.stamp, now);
  EXPECT_EQ(arrays[0].header.frame_id, "laser");
  std::vector<visualization_msgs::Marker> markers;
  EXPECT_TRUE(comesTrue([&] {
    markers = markersOf(now);
    return !markers.empty();
  }));
  for (const auto& marker : markers) {
    EXPECT_EQ(marker.action, visualization_msgs::Marker::DELETE);
  }
}

TEST_F(LineExtractorNode, BadScansAreDroppedAndCounted) {
  const test::Diagnostics diagnostics;
  const ros::Time now = ros::Time::now();
  auto no_beams = wallAhead(now);
  no_beams.ranges.clear();
  auto no_increment = wallAhead(now);
  no_increment.angle_increment = 0.0F;
  no_increment.angle_max = no_increment.angle_min;
  auto nan_increment = no_increment;
  nan_increment.angle_increment = kNan;
  const auto no_stamp = wallAhead(ros::Time());
  std::vector<sensor_msgs::LaserScan> scans;
  for (const auto& bad : {no_beams, no_increment, nan_increment, no_stamp}) {
    scans.push_back(bad);
    scans.push_back(wallAhead(now + ros::Duration(0.001 * static_cast<double>(scans.size()))));
  }
  EXPECT_EQ(answersTo(scans).size(), 4U) << "the good ones";
  const std::string name = "line_extractor: input /scan";
  EXPECT_TRUE(comesTrue([&] { return diagnostics.value(name, "dropped") == "4"; }))
      << diagnostics.value(name, "dropped");
  EXPECT_EQ(diagnostics.value(name, "last reason"), "a stamp of zero");
}

TEST_F(LineExtractorNode, SingleBadReturnsAreSkipped) {
  auto scan = wallAhead(ros::Time::now());
  for (std::size_t i = 5; i < scan.ranges.size(); i += 17) {
    scan.ranges[i] = i % 3 == 0 ? kNan : i % 3 == 1 ? 0.0F : -1.0F;
  }
  const auto arrays = answersTo({scan});
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
  set(5.0);
  const auto none = answersTo({wallAhead(ros::Time::now())});
  set(0.5);
  const auto one = answersTo({wallAhead(ros::Time::now())});
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
  const ros::Time now = ros::Time::now();
  const auto arrays = answersTo({wallAhead(now)});
  ASSERT_EQ(arrays.size(), 1U);
  EXPECT_EQ(arrays[0].header.stamp, now);
  EXPECT_EQ(arrays[0].segments.size(), 1U);
}

// The scanner turns by 0.1 rad in the 0.1 s of a sweep; odom says so.
class LinesInMotion : public LineExtractorNode {
 protected:
  LinesInMotion() : LineExtractorNode("moving/") {
    test::waitForConnection(ros::this_node::getName(), "/tf", "/moving/line_extractor");
  }

  // Odometry from a second before `stamp` to `reach` after it, in one message.
  void turn(const ros::Time& stamp, double reach) {
    std::vector<geometry_msgs::TransformStamped> transforms;
    for (double t = -1.0; t <= reach + 1e-6; t += 0.02) {
      transforms.push_back(odometry(stamp + ros::Duration(t), 0.7 + t));
    }
    broadcaster_.sendTransform(transforms);
    // Lines of a scan shortly before tell when the node knows of it.
    auto probe = wallAhead(stamp - ros::Duration(0.2), 0.1);
    EXPECT_TRUE(comesTrue([&] {
      probe.header.stamp += ros::Duration(0, 2);
      const auto arrays = answersTo({probe});
      return arrays.size() == 1 && arrays[0].segments.size() == 1;
    }));
  }

  static geometry_msgs::TransformStamped odometry(const ros::Time& stamp, double heading) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stamp;
    transform.header.frame_id = "odom";
    transform.child_frame_id = "laser";
    transform.transform = bridge::toTransform({3.0, -1.0, heading});
    return transform;
  }

  tf2_ros::TransformBroadcaster broadcaster_;
};

TEST_F(LinesInMotion, ALineHoldsAtTheStampWhateverTheSweep) {
  const ros::Time stamp = ros::Time::now() + ros::Duration(1.0);
  turn(stamp, 0.2);
  const auto arrays = answersTo({wallAhead(stamp, 0.1)});
  ASSERT_EQ(arrays.size(), 1U);
  ASSERT_EQ(arrays[0].segments.size(), 1U);
  EXPECT_NEAR(arrays[0].segments[0].rho, 2.0, 0.01);
  EXPECT_NEAR(arrays[0].segments[0].phi, 0.0, 0.005);
}

TEST_F(LinesInMotion, TheMotionOfAMomentAgoServesWhereOdometryLags) {
  const ros::Time stamp = ros::Time::now() + ros::Duration(1.8);
  turn(stamp, -0.1);
  const auto arrays = answersTo({wallAhead(stamp, 0.1)});
  ASSERT_EQ(arrays.size(), 1U);
  ASSERT_EQ(arrays[0].segments.size(), 1U);
  EXPECT_NEAR(arrays[0].segments[0].phi, 0.0, 0.005) << "the motion of a moment ago serves";
}

TEST_F(LinesInMotion, WithoutOdometryEveryScanIsAnsweredAllTheSame) {
  EXPECT_EQ(answersTo({wallAhead(ros::Time::now() + ros::Duration(1.9))}).size(), 1U);
}

TEST(LineExtractorParameters, OutOfRangeOrOfTheWrongTypeEndTheNode) {
  EXPECT_THAT(refusalOf("line_extractor", "_lines/gate:=0"), HasSubstr("lines.gate: 0 is outside"));
  EXPECT_THAT(refusalOf("line_extractor", "_lines/gate:=wide"),
              HasSubstr("lines.gate: expected a number, found 'wide'"));
  EXPECT_THAT(refusalOf("line_extractor", "_noise/kind:=white"),
              HasSubstr("noise.kind: 'white' is none of"));
}

}  // namespace
}  // namespace sightline
