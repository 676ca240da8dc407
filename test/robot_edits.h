#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <sensor_msgs/MultiEchoLaserScan.h>

#include "robot_run.h"

/// What robots of other people do to their messages, by the rows of a table of bug reports. Each is
/// an edit of a recording that is as it should be.
namespace sightline::test {

inline RobotInput asItShouldBe() {
  RobotInput input;
  input.name = "as_it_should_be";
  return input;
}

/// The first 30 samples of the odometry say this x; on tf, and on the topic.
inline RobotInput absurdOdometry(double x, double w = 1.0) {
  RobotInput input = asItShouldBe();
  input.name = "absurd_odometry";
  input.bag.transform = [=](geometry_msgs::TransformStamped& message, double time) {
    if (time >= 0.6) return;
    message.transform.translation.x = x;
    if (w != 1.0) message.transform.rotation = geometry_msgs::Quaternion();
    if (w != 1.0) message.transform.rotation.w = w;
  };
  input.bag.odometry = [=](nav_msgs::Odometry& message, double time) {
    if (time >= 0.6) return;
    message.pose.pose.position.x = x;
    if (w != 1.0) message.pose.pose.orientation = geometry_msgs::Quaternion();
    if (w != 1.0) message.pose.pose.orientation.w = w;
  };
  return input;
}

/// The same on the topic alone.
inline RobotInput onTopic(RobotInput input) {
  input.name += "_on_topic";
  input.bag.odometry_on_tf = false;
  input.bag.odometry_topic = "/odom";
  return input;
}

/// From a time on the odometry is moved by a pose in its own frame.
inline RobotInput leapingOdometry(double when, const geometry::Pose2& leap) {
  RobotInput input = asItShouldBe();
  input.name = "leaping_odometry";
  const auto moved = [=](const geometry::Pose2& pose, double time) {
    return time >= when ? leap * pose : pose;
  };
  input.bag.transform = [=](geometry_msgs::TransformStamped& message, double time) {
    message.transform = bridge::toTransform(moved(bridge::toPose2(message.transform), time));
  };
  input.bag.odometry = [=](nav_msgs::Odometry& message, double time) {
    message.pose.pose = bridge::toPose(moved(bridge::toPose2(message.pose.pose), time));
  };
  return input;
}

/// From a time on the odometry starts at zero again.
inline RobotInput resetOdometry(double when) {
  RobotInput input = asItShouldBe();
  input = leapingOdometry(when, input.bag.wheels(when).inverse());
  input.name = "reset_odometry";
  return input;
}

/// Nothing is seen beyond a range, which is reported as a value instead.
inline RobotInput missesAs(double range_max, double reported) {
  RobotInput input = asItShouldBe();
  input.name = "misses_as_" + std::to_string(reported);
  input.bag.scan = [=](sensor_msgs::LaserScan& scan, double) {
    scan.range_max = static_cast<float>(range_max);
    for (float& range : scan.ranges) {
      if (!(range < range_max)) range = static_cast<float>(reported);
    }
  };
  return input;
}

/// Every so many scans one has another stamp [s].
inline RobotInput strayStamps(const std::string& name, const std::function<double(double)>& stamp,
                              int every = 10) {
  RobotInput input = asItShouldBe();
  input.name = name;
  input.bag.scan = [=](sensor_msgs::LaserScan& scan, double time) {
    const auto index = static_cast<int>(std::lround(10.0 * time));
    if (index % every == 5) scan.header.stamp = ros::Time(stamp(scan.header.stamp.toSec()));
  };
  return input;
}

/// From a time on all stamps are shifted [s].
inline RobotInput steppingStamps(double when, double step) {
  RobotInput input = asItShouldBe();
  input.name = "stepping_stamps";
  const auto shift = [=](ros::Time& stamp, double time) {
    if (time >= when) stamp += ros::Duration(step);
  };
  input.bag.scan = [=](sensor_msgs::LaserScan& scan, double time) {
    shift(scan.header.stamp, time);
  };
  input.bag.transform = [=](geometry_msgs::TransformStamped& message, double time) {
    shift(message.header.stamp, time);
  };
  input.bag.odometry = [=](nav_msgs::Odometry& message, double time) {
    shift(message.header.stamp, time);
  };
  input.time_of_stamp = [=](double stamp) {
    const double time = stamp - kRobotStart;
    const bool is_new = time - step >= when - 1e-6 && time - step <= 20.0;
    return is_new ? time - step : time;
  };
  return input;
}

inline RobotInput withSlashes(bool backward) {
  RobotInput input = asItShouldBe();
  input.name = backward ? "slashes_backward" : "slashes";
  if (backward) input.bag.mounting.yaw = geometry::kPi;
  input.bag.laser = "/laser";
  input.bag.odom = "/odom";
  input.bag.base = "/base_link";
  return input;
}

/// Each turn comes in so many messages.
inline RobotInput partialSweeps(int parts) {
  RobotInput input = asItShouldBe();
  input.name = "partial_sweeps";
  input.bag.revolution = 0.1;
  input.bag.write_scan = [=](rosbag::Bag& bag, const ros::Time& recorded,
                             const sensor_msgs::LaserScan& whole) {
    const std::size_t beams = whole.ranges.size() / static_cast<std::size_t>(parts);
    for (int part = 0; part < parts; ++part) {
      sensor_msgs::LaserScan scan = whole;
      const std::size_t first = beams * static_cast<std::size_t>(part);
      const auto begin = whole.ranges.begin() + static_cast<std::ptrdiff_t>(first);
      scan.ranges.assign(begin, begin + static_cast<std::ptrdiff_t>(beams));
      const auto index = static_cast<float>(first);
      scan.angle_min = whole.angle_min + index * whole.angle_increment;
      scan.angle_max = scan.angle_min + static_cast<float>(beams - 1) * whole.angle_increment;
      const ros::Duration after(whole.time_increment * static_cast<double>(first));
      scan.header.stamp = whole.header.stamp + after;
      bag.write("/scan", recorded - ros::Duration(0.1) + after + ros::Duration(0.01), scan);
    }
  };
  return input;
}

/// The driver names the beams in the other order than the device takes them.
inline RobotInput mirroredScans() {
  RobotInput input = asItShouldBe();
  input.name = "mirrored_scans";
  input.bag.scan = [](sensor_msgs::LaserScan& scan, double) {
    std::reverse(scan.ranges.begin(), scan.ranges.end());
  };
  return input;
}

/// The robot turns to and fro as it drives, with a scanner of a whole circle a tenth of a second.
inline RobotInput turningToAndFro() {
  RobotInput input = asItShouldBe();
  input.name = "turning_to_and_fro";
  input.bag.wiggle = 0.5;
  input.bag.revolution = 0.1;
  input.judged_from = 8.0;
  return input;
}

/// The stamps of the scans are so much behind the first beam [s].
inline RobotInput lateStamps(double late) {
  RobotInput input = turningToAndFro();
  input.name = "late_stamps";
  input.bag.scan = [=](sensor_msgs::LaserScan& scan, double) {
    scan.header.stamp += ros::Duration(late);
  };
  input.time_of_stamp = [=](double stamp) { return stamp - kRobotStart - late; };
  return input;
}

/// The time from beam to beam is declared so many times as long as it is.
inline RobotInput otherSweeps(double factor) {
  RobotInput input = turningToAndFro();
  input.name = "other_sweeps";
  input.bag.scan = [=](sensor_msgs::LaserScan& scan, double) {
    scan.time_increment *= static_cast<float>(factor);
  };
  return input;
}

/// From one time to another the driver sends one scan over and over, with stamps that go on.
inline RobotInput repeatedScans(double from, double to) {
  RobotInput input = asItShouldBe();
  input.name = "repeated_scans";
  const auto kept = std::make_shared<std::vector<float>>();
  input.bag.scan = [=](sensor_msgs::LaserScan& scan, double time) {
    if (time < from || time >= to) {
      *kept = scan.ranges;
    } else {
      scan.ranges = *kept;
    }
  };
  return input;
}

inline RobotInput multiEcho() {
  RobotInput input = asItShouldBe();
  input.name = "multi_echo";
  input.bag.write_scan = [](rosbag::Bag& bag, const ros::Time& recorded,
                            const sensor_msgs::LaserScan& scan) {
    sensor_msgs::MultiEchoLaserScan message;
    message.header = scan.header;
    message.angle_min = scan.angle_min;
    message.angle_max = scan.angle_max;
    message.angle_increment = scan.angle_increment;
    message.range_min = scan.range_min;
    message.range_max = scan.range_max;
    for (const float range : scan.ranges) {
      message.ranges.emplace_back();
      if (std::isfinite(range)) message.ranges.back().echoes = {range, range + 0.5F};
    }
    bag.write("/scan", recorded, message);
  };
  return input;
}

}  // namespace sightline::test
