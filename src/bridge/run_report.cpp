#include "sightline/bridge/run_report.h"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include "sightline/LineSegmentArray.h"
#include "sightline/TrackerStatus.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/config/error.h"
#include "sightline/motion/pose_history.h"

namespace sightline::bridge {

namespace {

// The programs do not start and end together, nor do they connect at once.
constexpr double kLongestStart = 5.0;  // [s]
constexpr double kLongestEnd = 0.5;    // [s]

void addStatus(const TrackerStatus& status, RecordedRun& run) {
  if (!status.room.empty() && (run.rooms.empty() || run.rooms.back() != status.room)) {
    run.rooms.push_back(status.room);
  }
  for (const WallStatus& wall : status.walls) {
    if (!wall.accepted) continue;
    ++run.walls;
    run.beams += wall.beams_accepted;
  }
}

void add(const rosbag::MessageInstance& message, RecordedRun& run) {
  if (const auto scan = message.instantiate<sensor_msgs::LaserScan>()) {
    run.scans.push_back(nanoseconds(scan->header.stamp));
  } else if (const auto pose = message.instantiate<geometry_msgs::PoseWithCovarianceStamped>()) {
    run.poses.push_back({nanoseconds(pose->header.stamp), toPose2(pose->pose.pose)});
  } else if (const auto truth = message.instantiate<nav_msgs::Odometry>()) {
    run.truth.push_back({nanoseconds(truth->header.stamp), toPose2(truth->pose.pose)});
  } else if (const auto status = message.instantiate<TrackerStatus>()) {
    addStatus(*status, run);
  } else if (message.getDataType() == ros::message_traits::datatype<LineSegmentArray>()) {
    ++run.line_arrays;
  }
}

double seconds(std::int64_t nanoseconds) {
  return 1e-9 * static_cast<double>(nanoseconds);
}

void countScans(const RecordedRun& run, RunReport& report) {
  std::set<std::int64_t> posed;
  for (const geometry::StampedPose2& pose : run.poses) posed.insert(pose.stamp);
  const std::int64_t first = *posed.begin();
  const std::int64_t last = *posed.rbegin();
  for (const std::int64_t scan : run.scans) {
    if (scan < first) ++report.scans_before;
    if (scan > last) ++report.scans_after;
    if (scan > first && scan < last && posed.count(scan) == 0) ++report.scans_between;
  }
  report.seconds_before = std::max(0.0, seconds(first - run.scans.front()));
  report.seconds_after = std::max(0.0, seconds(run.scans.back() - last));
}

void comparePoses(const RecordedRun& run, RunReport& report) {
  motion::PoseHistory truth(std::numeric_limits<std::int64_t>::max() / 2);
  for (const geometry::StampedPose2& pose : run.truth) truth.add(pose.stamp, pose.pose);
  for (const geometry::StampedPose2& pose : run.poses) {
    const auto T_map_base = truth.at(pose.stamp);
    if (!T_map_base) {
      ++report.poses_without_truth;
      continue;
    }
    const geometry::Pose2 error = geometry::between(*T_map_base, pose.pose);
    report.errors.push_back({pose.stamp, error.translation().norm(), std::abs(error.theta())});
  }
}

std::string errorLine(const char* name, double position, double heading) {
  return fmt::format("{:<24}{:.4f} m, {:.3f} deg\n", name, position, geometry::degrees(heading));
}

}  // namespace

RecordedRun readRun(const std::string& bag) {
  RecordedRun run;
  try {
    const rosbag::Bag file(bag);
    rosbag::View view(
        file, rosbag::TopicQuery({"scan", "/scan", "pose", "/pose", "ground_truth", "/ground_truth",
                                  "tracker_status", "/tracker_status", "lines", "/lines"}));
    for (const rosbag::MessageInstance& message : view) add(message, run);
  } catch (const rosbag::BagException& error) {
    throw config::Error(bag, 0, "", std::string("not a readable bag: ") + error.what());
  }
  const auto need = [&](bool empty, const char* topic) {
    if (empty) throw config::Error(bag, 0, topic, "no message on this topic");
  };
  need(run.scans.empty(), "scan");
  need(run.poses.empty(), "pose");
  need(run.truth.empty(), "ground_truth");
  std::sort(run.scans.begin(), run.scans.end());
  return run;
}

RunReport judge(const RecordedRun& run) {
  RunReport report;
  countScans(run, report);
  comparePoses(run, report);
  return report;
}

bool RunReport::isGood(const PoseBounds& bounds) const {
  const bool complete = scans_between == 0 && seconds_before <= kLongestStart &&
                        seconds_after <= kLongestEnd && !errors.empty();
  return complete && std::all_of(errors.begin(), errors.end(), [&](const PoseError& error) {
           return error.position <= bounds.position && error.heading <= bounds.heading;
         });
}

std::string describe(const RecordedRun& run, const RunReport& report) {
  std::string text = fmt::format(
      "{:<24}{}\n{:<24}{}\n{:<24}{} before the first pose, {} after the last, {} between\n",
      "scans", run.scans.size(), "poses", run.poses.size(), "scans without a pose",
      report.scans_before, report.scans_after, report.scans_between);
  text += fmt::format("{:<24}{}\n", "poses without truth", report.poses_without_truth);
  text += fmt::format("{:<24}{}\n", "arrays of lines", run.line_arrays);
  text += fmt::format("{:<24}{}\n", "rooms", fmt::join(run.rooms, ", "));
  if (run.walls > 0) {
    text += fmt::format("{:<24}{:.1f}\n", "beams per wall",
                        static_cast<double>(run.beams) / static_cast<double>(run.walls));
  }
  if (report.errors.empty()) return text;
  double position = 0.0;
  double heading = 0.0;
  for (const PoseError& error : report.errors) {
    position = std::max(position, error.position);
    heading = std::max(heading, error.heading);
  }
  text +=
      errorLine("final pose error", report.errors.back().position, report.errors.back().heading);
  text += errorLine("largest pose error", position, heading);
  return text;
}

}  // namespace sightline::bridge
