#pragma once

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <ros/param.h>

#include "bench/figures.h"
#include "bench/live_node.h"

/// Load of the running node while it turns the head of a simulated robot where that tells most.
namespace sightline::bench {

/// The robot of demo.launch with its sensor on a head.
inline void setHeadParameters() {
  const std::string config = SIGHTLINE_SOURCE_DIR "/config/";
  const std::vector<double> start{-2.2, 4.6, 0.2};
  ros::param::set("/sim_sensor/world", config + "worlds/floor.yaml");
  ros::param::set("/sim_sensor/path", config + "paths/floor_tour.yaml");
  ros::param::set("/sim_sensor/start_pose", start);
  const std::string sensor = "/sim_sensor/active_sensors/sensor/";
  ros::param::set(sensor + "profile", config + "sensors/synchronised_scan.yaml");
  ros::param::set(sensor + "x", 0.1);
  ros::param::set(sensor + "z", 0.4);
  ros::param::set("/line_extractor/fixed_frame", std::string("odom"));
  ros::param::set("/room_tracker/map", config + "rooms/floor.yaml");
  ros::param::set("/room_tracker/initial_pose", start);
  for (const char* node : {"/line_extractor/", "/room_tracker/"}) {
    ros::param::set(std::string(node) + "range_scans", std::string("range_scan"));
  }
  ros::param::set("/gaze/map", config + "rooms/floor.yaml");
  ros::param::set("/gaze/mode", std::string("inform"));
}

inline void printGazeNode() {
  constexpr double kSeconds = 40.0;
  const Master master;
  setHeadParameters();
  const Process lines({SIGHTLINE_PROGRAMS "/line_extractor"});
  const Process tracker({SIGHTLINE_PROGRAMS "/room_tracker"});
  const Process gaze({SIGHTLINE_PROGRAMS "/gaze"});
  const Process robot({SIGHTLINE_PROGRAMS "/sim_sensor"});
  std::this_thread::sleep_for(std::chrono::seconds(5));
  print("gaze.node.cpu_percent", loadOf(gaze, kSeconds), "%");
}

}  // namespace sightline::bench
