#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>

#include "sightline/bridge/frames_check.h"
#include "sightline/bridge/recording_report.h"
#include "sightline/bridge/scanner_check.h"
#include "sightline/logs/step_comparison.h"
#include "sightline/pipeline/located_scan.h"

namespace sightline::bridge {

/// Looks through the messages of a robot, recorded or live, for what would keep the estimators from
/// working: stamps, ranges, frames, odometry, and whether odometry and scans tell of one motion.
class RecordingCheck {
 public:
  explicit RecordingCheck(const pipeline::Frames& frames) : frames_(frames) {}

  /// Counts a message of any topic.
  void count(const std::string& topic, const std::string& type);
  /// Arrival in [ns].
  void take(const std::string& topic, const sensor_msgs::LaserScan& message, std::int64_t arrival);
  /// Its first echoes are looked at.
  void take(const std::string& topic, const sensor_msgs::MultiEchoLaserScan& message,
            std::int64_t arrival);
  void take(const std::string& topic, const nav_msgs::Odometry& message, std::int64_t arrival);
  void take(const std::string& topic, const sensor_msgs::Imu& message, std::int64_t arrival);
  void take(const std::string& topic, const tf2_msgs::TFMessage& message);

  /// `source` is how the program to run is given the messages: names of bags, or nothing if live.
  RecordingReport report(const std::vector<std::string>& source) const;

 private:
  struct Topic {
    std::string type;
    std::size_t messages = 0;
  };
  struct Wheels {
    logs::StampCheck stamps;
    OdometryCheck poses;
    std::map<std::string, std::size_t> refused;  // poses that are none, by reason
    std::string odom;
    std::string base;
  };
  // Motion of the base by the scans alone, of the first scanner.
  struct Motion {
    std::vector<logs::ScanStep> steps;
    logs::Trajectory path;
    std::size_t scans = 0;
    std::size_t flagged = 0;      // steps that dead reckoning doubts
    bool turns_opposite = false;  // to those of the odometry
  };

  Section topicsSection() const;
  Section scannerSection(const std::string& topic, const ScannerCheck& scanner) const;
  Section framesSection() const;
  Section wheelsSection(const std::string& topic, const Wheels& wheels) const;
  Section motionSection(const Motion& motion) const;
  void addMounting(const ScannerCheck& scanner, Findings& findings) const;
  void addOffset(const logs::StepComparison& comparison, Findings& findings) const;
  Motion motionOfScans() const;
  /// Passes kept scans through a feed, as estimators get them, and hands them to `take`. Returns
  /// the number of those that were left out, by reason.
  std::map<std::string, std::size_t> pass(
      const std::deque<sensor_msgs::LaserScan>& scans,
      const std::function<void(const pipeline::LocatedScan&)>& take) const;
  /// The odometry that estimators would take: that of the transforms, otherwise that of a topic.
  const logs::Trajectory* odometry() const;
  bool isMounted(const ScannerCheck& scanner) const;
  std::string settings() const;
  /// Entry of the setting `body`; empty where the scanner does not see its robot.
  std::string bodyOf(const ScannerCheck& scanner) const;
  std::vector<std::string> nextSteps(const std::vector<std::string>& source) const;
  plot::Figure figure(const Motion& motion) const;

  pipeline::Frames names() const;

  FramesCheck frames_;
  std::map<std::string, Topic> topics_;
  std::map<std::string, ScannerCheck> scanners_;  // by topic
  std::map<std::string, Wheels> wheels_;
  std::map<std::string, logs::StampCheck> imus_;
  std::map<std::string, std::deque<sensor_msgs::LaserScan>> kept_;  // by topic
};

}  // namespace sightline::bridge
