#pragma once

#include <cstdint>
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include "nodes/comes_true.h"
#include "nodes/connections.h"
#include "nodes/recorder.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/simulation/scanner.h"
#include "sightline/world/room_map.h"

namespace sightline::test {

/// Plays the robot: stands in the living room, with odometry that says something else, and a
/// scanner mounted aside.
class LivingRoomRobot : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    static tf2_ros::StaticTransformBroadcaster mounting;
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "base_link";
    transform.child_frame_id = "laser";
    transform.transform = bridge::toTransform({0.2, 0.1, 0.3});
    mounting.sendTransform(transform);
  }

  LivingRoomRobot()
      : scanner_(profile(), mounting(), 3),
        scan_publisher_(node_.advertise<sensor_msgs::LaserScan>("scan", 10)) {
    const world::RoomMap map = world::RoomMap::readFile(std::string(SIGHTLINE_SOURCE_DIR) +
                                                        "/config/rooms/living_room.yaml");
    for (const geometry::Segment& wall : world::solidWalls(map)) {
      world::WorldSegment segment;
      segment.segment = wall;
      world_.add(segment);
    }
    for (const char* topic : {"/scan", "/tf", "/tf_static"}) {
      waitForConnection(ros::this_node::getName(), topic, "/room_tracker");
    }
  }

  static simulation::ScannerProfile profile() {
    simulation::ScannerProfile profile;
    profile.beams = 361;
    profile.revolution = 0.0;
    profile.noise.sigma = 0.01;
    return profile;
  }

  static simulation::Mounting mounting() {
    simulation::Mounting mounting;
    mounting.x = 0.2;
    mounting.y = 0.1;
    mounting.z = 0.4;
    mounting.yaw = 0.3;
    return mounting;
  }

  void sendOdometry(const ros::Time& stamp) {
    broadcaster_.sendTransform(
        bridge::toTransformMessage("odom", "base_link", bridge::nanoseconds(stamp), odometry_));
  }

  sensor_msgs::LaserScan look(const ros::Time& stamp) {
    auto message =
        bridge::toMessage(scanner_.sweep(world_, 1, [&](std::int64_t) { return truth_; }));
    message.header.stamp = stamp;
    message.header.frame_id = "laser";
    return message;
  }

  ros::Time scan() {
    const ros::Time now = ros::Time::now();
    sendOdometry(now);
    scan_publisher_.publish(look(now));
    return now;
  }

  /// Scans until there are that many answers: the first scans may come before tf has.
  template <class Message>
  Message scanUntil(Recorder<Message>& answers, std::size_t count = 1) {
    EXPECT_TRUE(comesTrue([&] { return answers.count() >= count; }, [this] { scan(); }));
    const auto messages = answers.all();
    return messages.empty() ? Message() : messages.back();
  }

  ros::NodeHandle node_;
  geometry::Pose2 truth_{-1.05, 0.45, 0.33};
  geometry::Pose2 odometry_{5.0, 3.0, -1.0};
  world::World world_;
  simulation::Scanner scanner_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher scan_publisher_;
};

}  // namespace sightline::test
