#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>

#include "bench/figures.h"
#include "bench/live_node.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/simulation/simulation.h"

/// Figures of the running node, fed with the scans of a simulated robot of 361 beams at 10 Hz.
///
/// odometry.node.cpu_percent: its share of one core. odometry.node.latency_median_ms, p99: from the
/// moment that a scan is published to that in which its odometry has arrived.
namespace sightline::bench {

/// Scans of a robot on a round tour of the demo's floor.
inline std::vector<scan::Scan> tourOfTheFloor(std::size_t scans) {
  const std::string source = SIGHTLINE_SOURCE_DIR;
  simulation::Simulation simulation(world::World::readFile(source + "/config/worlds/floor.yaml"),
                                    {}, geometry::Pose2(-2.2, 4.6, 0.2), 1);
  simulation::ScannerProfile profile;
  profile.beams = 361;
  profile.angle_min = geometry::radians(-90.0);
  profile.angle_max = geometry::radians(90.0);
  profile.rate = 10.0;
  simulation::Mounting mounting;
  mounting.z = 0.4;
  simulation.carrier().addScanner(profile, mounting);
  simulation.carrier().follow(simulation::Path::readFile(source + "/config/paths/floor_tour.yaml"));
  std::vector<scan::Scan> tour;
  while (tour.size() < scans) {
    for (auto& sweep : simulation.step().sweeps) tour.push_back(std::move(sweep.scan));
  }
  return tour;
}

inline void measureOdometryNode() {
  constexpr double kRate = 10.0;  // Hz
  constexpr std::size_t kScans = 350;
  std::vector<sensor_msgs::LaserScan> messages;
  for (scan::Scan& scan : tourOfTheFloor(kScans)) {
    scan.frame = "laser";
    messages.push_back(bridge::toMessage(scan));
  }
  const NodeLoad load = measureNode<sensor_msgs::LaserScan, nav_msgs::Odometry>(
      {SIGHTLINE_PROGRAMS "/laser_odometry", "_start_patience:=0"}, "scan", "laser_odom", messages,
      kRate, static_cast<double>(kScans) / kRate);
  print("odometry.node.answered",
        100.0 * static_cast<double>(load.latencies_ms.size()) / static_cast<double>(kScans), "%");
  print("odometry.node.latency_median_ms", median(load.latencies_ms), "ms");
  print("odometry.node.latency_p99_ms", quantile(load.latencies_ms, 0.99), "ms");
  print("odometry.node.cpu_percent", load.cpu_percent, "%");
}

}  // namespace sightline::bench
