#pragma once

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <ros/param.h>

#include "bench/figures.h"
#include "bench/live_node.h"

/// Load of the running node while a simulated robot drives: 361 beams at 10 Hz.
namespace sightline::bench {

/// The robot of simulated_robot.launch, with fewer beams.
inline void setRobotParameters() {
  const std::string source = SIGHTLINE_SOURCE_DIR;
  const std::string node = "/sim_sensor/";
  ros::param::set(node + "world", source + "/config/worlds/floor.yaml");
  ros::param::set(node + "path", source + "/config/paths/floor_tour.yaml");
  ros::param::set(node + "start_pose", std::vector<double>{-2.2, 4.6, 0.2});
  const std::string laser = node + "scanners/laser/";
  ros::param::set(laser + "profile", source + "/config/sensors/utm30lx.yaml");
  ros::param::set(laser + "beams", 361);
  ros::param::set(laser + "angle_min", -1.5707963);
  ros::param::set(laser + "angle_max", 1.5707963);
  ros::param::set(laser + "rate", 10.0);
  ros::param::set(laser + "topic", std::string("scan"));
  ros::param::set(laser + "x", 0.1);
  ros::param::set(laser + "z", 0.4);
  ros::param::set("/room_tracker/map", source + "/config/rooms/floor.yaml");
  ros::param::set("/room_tracker/initial_pose", std::vector<double>{-2.2, 4.6, 0.2});
}

/// Prints rooms.node.{cpu_percent,peak_mb}, and idle_percent: of a node without any input.
inline void printNode() {
  const Master master;
  setRobotParameters();
  const Process tracker({SIGHTLINE_PROGRAMS "/room_tracker"});
  std::this_thread::sleep_for(std::chrono::seconds(3));
  print("rooms.node.idle_percent", loadOf(tracker, 10.0), "%");
  const Process robot({SIGHTLINE_PROGRAMS "/sim_sensor"});
  std::this_thread::sleep_for(std::chrono::seconds(3));
  print("rooms.node.cpu_percent", loadOf(tracker, 40.0), "%");
  print("rooms.node.peak_mb", tracker.peakMegabytes(), "MB");
}

}  // namespace sightline::bench
