#pragma once

#include <vector>

#include "odometry.h"

/// Faults of scans, their stamps, frames and topics.
namespace sightline::bench {

inline RobotInput scansEdited(const std::string& name,
                              const std::function<void(sensor_msgs::LaserScan&, double)>& edit) {
  RobotInput input = named(name, test::asItShouldBe());
  input.bag.scan = edit;
  return input;
}

inline bool isEvery(int number, double time) {
  return std::lround(10.0 * time) % number == number / 2;
}

inline void addMisses(std::vector<RobotInput>& inputs) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const auto& [range_max, reported] : {std::pair{2.2, 2.2},
                                            {2.2, 2.15},
                                            {2.2, 2.1999},
                                            {3.0, 3.0},
                                            {3.0, 2.9},
                                            {1.5, 1.5},
                                            {2.2, kInfinity},
                                            {2.2, 0.0},
                                            {2.2, -1.0},
                                            {2.2, std::nan("")},
                                            {2.2, 2.3}}) {
    inputs.push_back(named(fmt::format("misses as {:g} of {:g}", reported, range_max),
                           test::missesAs(range_max, reported)));
  }
  inputs.push_back(scansEdited("misses as 65.535 of 100", [](sensor_msgs::LaserScan& scan, double) {
    scan.range_max = 100.0F;
    for (float& range : scan.ranges) {
      if (!(range < 2.2F)) range = 65.535F;
    }
  }));
  inputs.push_back(
      scansEdited("misses as 2.2, centimetres", [](sensor_msgs::LaserScan& scan, double) {
        scan.range_max = 2.2F;
        for (float& range : scan.ranges) range = 0.01F * std::round(100.0F * std::min(range, 2.2F));
      }));
}

inline void addStrayStamps(std::vector<RobotInput>& inputs) {
  for (const int every : {3, 10}) {
    const auto add = [&](const std::string& name, const std::function<double(double)>& stamp) {
      inputs.push_back(test::strayStamps(fmt::format("{}, every {}", name, every), stamp, every));
    };
    add("stamp zero", [](double) { return 0.0; });
    add("stamp at the end of time", [](double) { return 4294967295.0; });
    for (const double off : {-402.0, -20.0, 15.0, 3600.0}) {
      add(fmt::format("stamp off by {} s", off), [=](double stamp) { return stamp + off; });
    }
  }
  for (const double step : {-100.0, 100.0, -20.0, -3600.0, 3600.0, 15.0}) {
    inputs.push_back(
        named(fmt::format("stamps step by {} s", step), test::steppingStamps(10.0, step)));
    inputs.push_back(named(fmt::format("stamps step by {} s on a topic", step),
                           test::onTopic(test::steppingStamps(10.0, step))));
  }
}

inline void addOddFields(std::vector<RobotInput>& inputs) {
  using Scan = sensor_msgs::LaserScan;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float increment : {153333.0F, 153.0F, kNan, -3e-4F}) {
    inputs.push_back(scansEdited(fmt::format("time_increment {:g}", increment),
                                 [=](Scan& scan, double) { scan.time_increment = increment; }));
  }
  for (const std::size_t length : {359U, 1U, 720U}) {
    inputs.push_back(scansEdited(fmt::format("{} intensities", length), [=](Scan& scan, double) {
      scan.intensities.assign(length, 100.0F);
    }));
  }
  for (const float increment : {0.0F, kNan, 1.0F}) {
    inputs.push_back(scansEdited(fmt::format("angle_increment {:g}", increment),
                                 [=](Scan& scan, double) { scan.angle_increment = increment; }));
  }
  inputs.push_back(scansEdited("range_max 0", [](Scan& scan, double) { scan.range_max = 0.0F; }));
  inputs.push_back(
      scansEdited("range_min nan", [=](Scan& scan, double) { scan.range_min = kNan; }));
  inputs.push_back(scansEdited("every fourth scan empty", [](Scan& scan, double time) {
    if (isEvery(4, time)) scan.ranges.clear();
  }));
  inputs.push_back(scansEdited("every fourth scan blind", [=](Scan& scan, double time) {
    if (isEvery(4, time)) std::fill(scan.ranges.begin(), scan.ranges.end(), kNan);
  }));
  inputs.push_back(scansEdited("every fourth scan twice", [](Scan& scan, double time) {
    if (isEvery(4, time)) scan.header.stamp -= ros::Duration(0.1);
  }));
}

inline void addMountings(std::vector<RobotInput>& inputs) {
  const auto add = [&](const std::string& name, double roll, double pitch, double yaw) {
    RobotInput input = named(name, test::asItShouldBe());
    input.bag.mounting.roll = roll;
    input.bag.mounting.pitch = pitch;
    input.bag.mounting.yaw = yaw;
    inputs.push_back(input);
  };
  add("scanner upside down", geometry::kPi, 0.0, 0.0);
  add("scanner upside down and backward", geometry::kPi, 0.0, geometry::kPi);
  add("scanner backward", 0.0, 0.0, geometry::kPi);
  add("scanner tilted by 5 degrees", 0.0, geometry::radians(-5.0), 0.0);
  add("scanner tilted by 60 degrees", 0.0, geometry::radians(-60.0), 0.0);
  RobotInput optical = named("mounting of an optical frame", test::asItShouldBe());
  optical.bag.mount = [](geometry_msgs::TransformStamped& mount) {
    auto& q = mount.transform.rotation;
    q.x = q.z = -0.5;
    q.y = q.w = 0.5;
  };
  inputs.push_back(optical);
  inputs.push_back(named("slashes", test::withSlashes(false)));
  inputs.push_back(named("slashes, backward", test::withSlashes(true)));
}

inline void addDrivers(std::vector<RobotInput>& inputs) {
  inputs.push_back(named("beams in the opposite sense", test::mirroredScans()));
  inputs.push_back(named("beams in the opposite sense, odometry on a topic",
                         test::onTopic(test::mirroredScans())));
  inputs.push_back(named("turning to and fro", test::turningToAndFro()));
  for (const double late : {0.05, 0.1, 0.3, -0.05}) {
    inputs.push_back(named(fmt::format("stamps {} s late", late), test::lateStamps(late)));
  }
  for (const double factor : {-1.0, 0.0, 0.05}) {
    inputs.push_back(
        named(fmt::format("time_increment {} times as long", factor), test::otherSweeps(factor)));
  }
  for (const double length : {0.5, 2.0, 5.0}) {
    inputs.push_back(named(fmt::format("one scan repeated for {} s", length),
                           test::repeatedScans(8.0, 8.0 + length)));
  }
}

inline void addTopics(std::vector<RobotInput>& inputs) {
  for (const int parts : {2, 3, 12, 36}) {
    inputs.push_back(named(fmt::format("turns in {} parts", parts), test::partialSweeps(parts)));
  }
  inputs.push_back(named("several echoes", test::multiEcho()));
  inputs.push_back(named("odometry on a topic", test::onTopic(test::asItShouldBe())));
  RobotInput bare = named("topics without slashes", test::asItShouldBe());
  bare.bag.scan_topic = "scan";
  bare.bag.tf_topic = "tf";
  bare.bag.static_topic = "tf_static";
  inputs.push_back(bare);
  RobotInput split = named("three bags", test::asItShouldBe());
  split.splits = {5.0, 10.0};
  inputs.push_back(split);
  RobotInput unmounted = named("no mounting", test::asItShouldBe());
  unmounted.bag.static_topic.clear();
  inputs.push_back(unmounted);
  unmounted.settings = "mountings: {laser: [0.1, 0.0, 0.0]}\n";
  inputs.push_back(named("mounting in the settings", unmounted));
  RobotInput rest = named("at rest", test::asItShouldBe());
  rest.bag.moves = false;
  inputs.push_back(rest);
}

}  // namespace sightline::bench
