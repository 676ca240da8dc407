#pragma once

#include <vector>

#include <fmt/format.h>

#include "robot_edits.h"

/// Faults of odometry.
namespace sightline::bench {

using test::RobotInput;

inline RobotInput named(const std::string& name, RobotInput input) {
  input.name = name;
  return input;
}

/// Edits each pose of the odometry, on tf and on the topic.
inline RobotInput odometryEdited(
    const std::string& name,
    const std::function<geometry::Pose2(const geometry::Pose2&, double)>& edit) {
  RobotInput input = named(name, test::asItShouldBe());
  input.bag.transform = [=](geometry_msgs::TransformStamped& message, double time) {
    message.transform = bridge::toTransform(edit(bridge::toPose2(message.transform), time));
  };
  input.bag.odometry = [=](nav_msgs::Odometry& message, double time) {
    message.pose.pose = bridge::toPose(edit(bridge::toPose2(message.pose.pose), time));
  };
  return input;
}

/// Leaves the odometry out at some times.
inline RobotInput odometryGaps(const std::string& name, const std::function<bool(double)>& is_gap) {
  RobotInput input = named(name, test::asItShouldBe());
  input.bag.transform = [=](geometry_msgs::TransformStamped& message, double time) {
    if (is_gap(time)) message.header.frame_id.clear();
  };
  return input;
}

inline void addAbsurdOdometry(std::vector<RobotInput>& inputs) {
  for (const double x :
       {1e256, 1e155, 1e40, 1e6, -1e8, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const std::string name = fmt::format("odometry x={:g}", x);
    inputs.push_back(named(name, test::absurdOdometry(x)));
    inputs.push_back(named(name + " on a topic", test::onTopic(test::absurdOdometry(x))));
  }
  for (const double w : {std::numeric_limits<double>::denorm_min(), 0.0, 7.0, std::nan("")}) {
    inputs.push_back(named(fmt::format("odometry with a quaternion of w={:g}", w),
                           test::absurdOdometry(0.0, w)));
  }
}

inline void addLeapsOfOdometry(std::vector<RobotInput>& inputs) {
  using geometry::Pose2;
  for (const double when : {3.0, 10.0, 17.0}) {
    inputs.push_back(named(fmt::format("odometry reset at {}", when), test::resetOdometry(when)));
    inputs.push_back(named(fmt::format("odometry reset at {} on a topic", when),
                           test::onTopic(test::resetOdometry(when))));
  }
  for (const Pose2& leap :
       {Pose2(1.0, 0.0, 0.0), Pose2(-2.0, 1.0, 0.0), Pose2(0.5, 0.0, 0.0), Pose2(0.3, 0.0, 0.0),
        Pose2(0.0, 0.0, 1.6), Pose2(0.0, 0.0, 0.5), Pose2(0.0, 0.0, -0.3), Pose2(50.0, 3.0, 3.1)}) {
    const std::string name =
        fmt::format("odometry leaps by {} {} {}", leap.x(), leap.y(), leap.theta());
    RobotInput input = named(name, test::leapingOdometry(9.3, leap));
    inputs.push_back(input);
    input.bag.odometry_rate = 10.0;
    inputs.push_back(named(name + " at 10 Hz", input));
  }
  for (const double far : {1e30, 50.0, 2.0}) {
    inputs.push_back(odometryEdited(fmt::format("samples of odometry off by {:g} m", far),
                                    [=](const Pose2& pose, double time) {
                                      const bool is_off = std::lround(50.0 * time) % 73 == 40;
                                      return is_off ? Pose2(far, 0.0, 0.0) * pose : pose;
                                    }));
  }
}

inline void addPoorOdometry(std::vector<RobotInput>& inputs) {
  using geometry::Pose2;
  inputs.push_back(odometryEdited("odometry 10 % long", [](const Pose2& pose, double) {
    return Pose2(1.1 * pose.translation(), pose.theta());
  }));
  inputs.push_back(odometryGaps("odometry of 5 Hz",
                                [](double time) { return std::lround(1000.0 * time) % 200 != 0; }));
  inputs.push_back(
      odometryGaps("a second without odometry", [](double t) { return t > 8.0 && t < 9.0; }));
  inputs.push_back(
      odometryGaps("four seconds without odometry", [](double t) { return t > 8.0 && t < 12.0; }));
  RobotInput late = named("odometry recorded 0.3 s late", test::asItShouldBe());
  late.bag.odometry_delay = 0.3;
  inputs.push_back(late);
  RobotInput ends = odometryGaps("odometry ends half way", [](double t) { return t > 10.0; });
  inputs.push_back(ends);
}

}  // namespace sightline::bench
