#include "sightline/bridge/bag_from_carmen.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include "carmen_room.h"
#include "config_error.h"
#include "sightline/bridge/pose_conversion.h"
#include "temporary_folder.h"

namespace sightline::bridge {
namespace {

using test::errorOf;
using test::TemporaryFolder;
using testing::HasSubstr;

struct BagContents {
  std::vector<sensor_msgs::LaserScan> scans;
  std::vector<nav_msgs::Odometry> odometry;
  std::vector<tf2_msgs::TFMessage> transforms;
  std::vector<ros::Time> times;  // of writing
};

BagContents contentsOf(const std::string& path) {
  BagContents contents;
  rosbag::Bag bag(path);
  rosbag::View view(bag);
  for (const rosbag::MessageInstance& instance : view) {
    contents.times.push_back(instance.getTime());
    if (const auto m = instance.instantiate<sensor_msgs::LaserScan>()) contents.scans.push_back(*m);
    if (const auto m = instance.instantiate<nav_msgs::Odometry>()) contents.odometry.push_back(*m);
    if (const auto m = instance.instantiate<tf2_msgs::TFMessage>()) {
      contents.transforms.push_back(*m);
    }
  }
  return contents;
}

BagContents convert(const std::string& log, const CarmenBagOptions& options) {
  const TemporaryFolder folder;
  writeCarmenBag(logs::readCarmenLog(folder.write("a.clf", log)), options, folder.path("a.bag"));
  return contentsOf(folder.path("a.bag"));
}

TEST(CarmenBag, HoldsScansOdometryAndTransformsInTheOrderOfTheirStamps) {
  const BagContents bag = convert(test::carmenRoomLog(10), {});
  EXPECT_EQ(bag.scans.size(), 10U);
  EXPECT_EQ(bag.odometry.size(), 20U);
  EXPECT_EQ(bag.transforms.size(), 20U);
  EXPECT_TRUE(std::is_sorted(bag.times.begin(), bag.times.end()));
  EXPECT_EQ(bag.scans[1].header.stamp, ros::Time(100, 200000000));
  EXPECT_EQ(bag.scans[1].header.frame_id, "laser");
  EXPECT_EQ(bag.odometry[1].header.stamp, ros::Time(100, 100000000));
  EXPECT_EQ(bag.odometry[1].header.frame_id, "odom");
  EXPECT_EQ(bag.odometry[1].child_frame_id, "base_link");
  EXPECT_EQ(bag.odometry[1].twist.twist.linear.x, 0.3);
  EXPECT_EQ(bag.odometry[1].twist.twist.angular.z, 0.1);
  const geometry::Pose2 pose = toPose2(bag.odometry[1].pose.pose);
  const geometry::Pose2 expected = test::carmenRobotAt(0.1);
  EXPECT_NEAR((pose.coordinates() - expected.coordinates()).norm(), 0.0, 1e-5);
}

TEST(CarmenBag, DescribesTheScannerByItsLine) {
  const BagContents bag = convert(test::carmenRoomLog(1), {});
  const sensor_msgs::LaserScan& scan = bag.scans.front();
  EXPECT_NEAR(scan.angle_min, geometry::radians(-90.0), 1e-6);
  EXPECT_NEAR(scan.angle_max, geometry::radians(90.0), 1e-6);
  EXPECT_NEAR(scan.angle_increment, geometry::radians(1.0), 1e-8);
  EXPECT_EQ(scan.time_increment, 0.0F);
  EXPECT_NEAR(scan.range_max, 80.99, 1e-5);
  EXPECT_EQ(scan.ranges.size(), 181U);
}

TEST(CarmenBag, SaysNothingAndInvalidAsRosDoes) {
  const std::string end = " 0 0 0 0 0 0 12.5 host 0\n";
  const auto ranges = convert("FLASER 4 0 81.83 2.5 -1" + end, {}).scans.front().ranges;
  EXPECT_TRUE(std::isnan(ranges[0]));
  EXPECT_TRUE(std::isinf(ranges[1]) && ranges[1] > 0.0F);
  EXPECT_EQ(ranges[2], 2.5F);
  EXPECT_TRUE(std::isnan(ranges[3]));
  // A limit the log states, and one that a line states for itself.
  EXPECT_TRUE(std::isinf(convert("PARAM robot_front_laser_max 8.0 1 h 1\nFLASER 2 8.1 1" + end, {})
                             .scans.front()
                             .ranges[0]));
  const auto own =
      convert("ROBOTLASER1 0 -2 4 1 4.0 0.01 0 2 9.99 1 0 0 0 0 0 0 0 0 0 0 0 0 12.5 h 0\n", {});
  EXPECT_TRUE(std::isinf(own.scans.front().ranges[0]));
  EXPECT_EQ(own.scans.front().range_max, 4.0F);
}

TEST(CarmenBag, RepeatsTheMountingWithEachPose) {
  CarmenBagOptions options;
  options.laser_offset = 0.12;
  for (const tf2_msgs::TFMessage& message : convert(test::carmenRoomLog(3), options).transforms) {
    ASSERT_EQ(message.transforms.size(), 2U);
    EXPECT_EQ(message.transforms[0].header.frame_id, "odom");
    EXPECT_EQ(message.transforms[0].child_frame_id, "base_link");
    EXPECT_EQ(message.transforms[1].header.frame_id, "base_link");
    EXPECT_EQ(message.transforms[1].child_frame_id, "laser");
    EXPECT_EQ(message.transforms[1].transform.translation.x, 0.12);
    EXPECT_EQ(message.transforms[1].header.stamp, message.transforms[0].header.stamp);
  }
}

TEST(CarmenBag, StampsTheOdometryLater) {
  CarmenBagOptions options;
  options.odometry_delay = 0.12;
  const BagContents bag = convert(test::carmenRoomLog(5), options);
  EXPECT_EQ(bag.odometry.front().header.stamp, ros::Time(100, 120000000));
  EXPECT_EQ(bag.scans.front().header.stamp, ros::Time(100, 0));
  EXPECT_TRUE(std::is_sorted(bag.times.begin(), bag.times.end()));
}

TEST(CarmenBag, RepairsBackwardStepsOnlyWhenAsked) {
  const std::string log = "FLASER 2 1 1 0 0 0 0 0 0 12.0 h 0\nODOM 0 0 0 0 0 0 12.0 h 0\n" +
                          std::string("ODOM 1 0 0 -1 0 0 13.0 h 0\n");
  CarmenBagOptions options;
  EXPECT_EQ(convert(log, options).odometry.back().pose.pose.position.x, 1.0);
  options.reverse_from_tv = true;
  EXPECT_EQ(convert(log, options).odometry.back().pose.pose.position.x, -1.0);
}

TEST(CarmenBag, SaysWhatALogLacks) {
  EXPECT_THAT(errorOf([] { convert("ODOM 0 0 0 0 0 0 12.0 h 0\n", {}); }).reason(),
              HasSubstr("no scans in the log"));
  CarmenBagOptions options;
  options.reverse_from_tv = true;
  EXPECT_EQ(errorOf([&] { convert("FLASER 2 1 1 0 0 0 0 0 0 12.0 h 0\n", options); }).key(),
            "reverse_from_tv");
  options.odometry_delay = 1e3;
  EXPECT_EQ(errorOf([&] { convert(test::carmenRoomLog(1), options); }).key(), "odometry_delay");
}

}  // namespace
}  // namespace sightline::bridge
