#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <rosbag/view.h>

#include "robot_bag.h"
#include "sightline/TrackerStatus.h"
#include "sightline/logs/trajectory.h"
#include "temporary_folder.h"
#include "tools/program.h"

/// The program `offline` on the recording of a robot, judged by where the robot really was.
namespace sightline::test {

struct RobotInput {
  std::string name;
  RobotBag bag;
  std::string settings;        // further lines of the configuration file
  std::string rooms_settings;  // further lines of its rooms
  std::string options;         // of the command line
  std::vector<double> splits;  // times at which a bag ends and the next one begins [s]
  std::function<double(double)> time_of_stamp;  // where stamps are not what they should be [s]
  double judged_from = 0.0;                     // time before which a fault cannot be known [s]
};

struct RobotError {
  double position = 0.0;  // [m]
  double heading = 0.0;   // [deg]
};

struct RobotRun {
  int status = 0;
  std::string output;
  std::size_t room_poses = 0;
  std::size_t odometry_poses = 0;
  std::size_t tracking = 0;  // scans with a pose that is said to be good
  std::size_t not_tracking = 0;
  std::size_t flagged = 0;  // matches that are said to be doubtful
  bool has_nan = false;
  RobotError rooms_worst;  // of poses that are said to be good
  RobotError rooms_end;
  RobotError odometry_end;

  bool isCrash() const { return status >= 124; }
  bool isSilentlyWrong() const {
    const auto isWrong = [](const RobotError& e) { return e.position > 0.1 || e.heading > 3.0; };
    return has_nan || isWrong(rooms_worst) || (flagged == 0 && isWrong(odometry_end));
  }
};

inline RobotError errorBetween(const geometry::Pose2& truth, const geometry::Pose2& pose) {
  const geometry::Pose2 error = geometry::between(truth, pose);
  return {error.translation().norm(), std::abs(geometry::degrees(error.theta()))};
}

inline double timeOf(const RobotInput& input, std::int64_t stamp) {
  const double seconds = 1e-9 * static_cast<double>(stamp);
  return input.time_of_stamp ? input.time_of_stamp(seconds) : seconds - kRobotStart;
}

inline std::map<std::int64_t, std::uint8_t> statesIn(const std::string& bag_path) {
  std::map<std::int64_t, std::uint8_t> states;
  rosbag::Bag bag(bag_path);
  rosbag::View view(bag, rosbag::TopicQuery("/tracker_status"));
  for (const rosbag::MessageInstance& message : view) {
    const auto status = message.instantiate<TrackerStatus>();
    states[bridge::nanoseconds(status->header.stamp)] = status->state;
  }
  return states;
}

inline void judgeRooms(const RobotInput& input, const TemporaryFolder& folder, RobotRun& run) {
  const auto states = statesIn(folder.path("out/out.bag"));
  for (const auto& posed : logs::readTrajectory(folder.path("out/rooms.tum"))) {
    const auto error = errorBetween(input.bag.truth(timeOf(input, posed.stamp)), posed.pose);
    run.has_nan |= !posed.pose.isFinite();
    run.rooms_end = error;
    ++run.room_poses;
    const auto state = states.find(posed.stamp);
    const bool is_good = state != states.end() && state->second == TrackerStatus::TRACKING;
    ++(is_good ? run.tracking : run.not_tracking);
    if (!is_good || timeOf(input, posed.stamp) < input.judged_from) continue;
    run.rooms_worst.position = std::max(run.rooms_worst.position, error.position);
    run.rooms_worst.heading = std::max(run.rooms_worst.heading, error.heading);
  }
}

inline void judgeOdometry(const RobotInput& input, const TemporaryFolder& folder, RobotRun& run) {
  const auto poses = logs::readTrajectory(folder.path("out/odometry.tum"));
  run.odometry_poses = poses.size();
  if (poses.empty()) return;
  const auto truthOf = [&](const geometry::StampedPose2& posed) {
    return input.bag.truth(timeOf(input, posed.stamp));
  };
  for (const auto& posed : poses) run.has_nan |= !posed.pose.isFinite();
  const auto first = std::find_if(poses.begin(), std::prev(poses.end()), [&](const auto& posed) {
    return timeOf(input, posed.stamp) >= input.judged_from;
  });
  const auto start = truthOf(*first) * first->pose.inverse();
  run.odometry_end = errorBetween(truthOf(poses.back()), start * poses.back().pose);
  const auto place = run.output.find(" of them flagged");
  if (place == std::string::npos) return;
  const auto before = run.output.rfind(' ', place - 1);
  run.flagged = std::stoul(run.output.substr(before + 1, place - before - 1));
}

inline std::string settingsOf(const RobotInput& input) {
  const geometry::Pose2 start = input.bag.truth(0.1);
  return "rooms:\n  map: rooms.yaml\n  initial_pose: [" + std::to_string(start.x()) + ", " +
         std::to_string(start.y()) + ", " + std::to_string(start.theta()) + "]\n" +
         input.rooms_settings + "odometry: {}\n" + input.settings;
}

inline std::string writeBags(const RobotInput& input, const TemporaryFolder& folder) {
  std::vector<double> ends = input.splits;
  ends.push_back(1e9);
  std::string paths;
  double begin = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const std::string path = folder.path("in" + std::to_string(i) + ".bag");
    input.bag.write(path, begin, ends[i]);
    begin = ends[i];
    paths += " " + path;
  }
  return paths;
}

/// Runs offline on bags that are there already.
inline RobotRun runOffline(const RobotInput& input, const TemporaryFolder& folder,
                           const std::string& bags) {
  folder.write("rooms.yaml", kRobotRooms);
  folder.write("a.yaml", settingsOf(input));
  // What hangs is ended, with 124 for its status.
  const auto result =
      runCommand("timeout 100 " SIGHTLINE_PROGRAMS "/offline --config " + folder.path("a.yaml") +
                 bags + " --out " + folder.path("out") + " " + input.options);
  RobotRun run;
  run.status = result.status;
  run.output = result.output;
  if (run.isCrash()) return run;
  const auto hasPoses = [&](const char* name) {
    return std::filesystem::exists(folder.path(name)) &&
           std::filesystem::file_size(folder.path(name)) > 0;
  };
  if (hasPoses("out/rooms.tum")) judgeRooms(input, folder, run);
  if (hasPoses("out/odometry.tum")) judgeOdometry(input, folder, run);
  return run;
}

inline RobotRun runOffline(const RobotInput& input) {
  const TemporaryFolder folder;
  return runOffline(input, folder, writeBags(input, folder));
}

}  // namespace sightline::test
