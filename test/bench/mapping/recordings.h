#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/figures.h"
#include "bench/rooms/playback.h"
#include "sightline/bridge/bag_feed.h"
#include "sightline/bridge/bag_from_carmen.h"
#include "sightline/bridge/recorded_estimates.h"
#include "sightline/logs/carmen_stamps.h"
#include "sightline/logs/trajectory_error.h"
#include "sightline/mapping/recorded_tracker.h"
#include "sightline/mapping/room_fitter.h"
#include "temporary_folder.h"

/// Adjusted paths and fitted rooms of recordings, against their hand-verified relations.
namespace sightline::bench {

class MappedRecording {
 public:
  /// @param name     of the log in SIGHTLINE_DATA
  /// @param config   settings
  /// @param measured where the relations hold, T_base_measured
  MappedRecording(const std::string& name, const bridge::CarmenBagOptions& options,
                  const std::string& config, const geometry::Pose2& measured)
      : name_(name),
        data_(std::getenv("SIGHTLINE_DATA")),
        config_(
            pipeline::EstimatorsConfig::readFile(SIGHTLINE_SOURCE_DIR "/config/offline/" + config)),
        measured_(measured) {
    const auto log = logs::readCarmenLog((data_ / (name + ".clf.gz")).string());
    bridge::writeCarmenBag(log, options, folder_.path("in.bag"));
  }

  void printPoses(bool with_wheels) const {
    const mapping::Survey survey = surveyed(with_wheels);
    const auto adjusted = mapping::PathAdjuster(survey.keys(), {}).adjust();
    const std::string suffix = with_wheels ? "" : "_laser_only";
    print(mapping::posesOf(survey.path(), survey.keys(), adjusted.keys),
          "mapping." + name_ + suffix + ".poses.");
  }

  /// Fits rooms, and tracks the same recording in them.
  void printRooms() const {
    const double begin = threadTime();
    const mapping::Survey survey = surveyed(true);
    const mapping::FittedRooms fitted = mapping::fitRooms(survey, {});
    bench::print("mapping.seconds", threadTime() - begin, "s");
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    bench::print("mapping.peak_mb", static_cast<double>(usage.ru_maxrss) / 1024.0, "MB");
    fmt::print("# {}: {} rooms, {} doors\n", name_, fitted.rooms.size(), fitted.doors.size());
    bench::print("mapping." + name_ + ".missing_doors",
                 static_cast<double>(fitted.missing_doors.size()), "1");
    folder_.write("rooms.yaml", mapping::roomsText(fitted));
    print(tracked(fitted.poses.front()), "mapping." + name_ + ".");
  }

  /// Fits rooms without wheels, and tracks the same recording in them by dead reckoning.
  void printRoomsWithoutWheels() const {
    const mapping::Survey survey = surveyed(false);
    const mapping::FittedRooms fitted = mapping::fitRooms(survey, {});
    folder_.write("rooms.yaml", mapping::roomsText(fitted));
    auto config = inRooms(fitted.poses.front());
    config.input.feed.odometry_source = pipeline::OdometrySource::kNone;
    mapping::RecordedTracker tracker(config, mapping::odometryOf(survey));
    logs::Trajectory trajectory;
    read(config, [&](pipeline::LocatedScan located, const ros::Time&) {
      const auto rooms = tracker.take(std::move(located)).rooms;
      if (rooms) trajectory.push_back({rooms->stamp, rooms->pose.mean});
    });
    print(trajectory, "mapping." + name_ + "_laser_only.");
  }

  /// Fits rooms to the first half, and tracks the whole: the figures are those of the second half
  /// where it is in these rooms, by the adjusted path of all.
  void printSplit() const {
    const std::int64_t half = halfTime();
    mapping::Survey survey(config_);
    read(config_, [&](pipeline::LocatedScan located, const ros::Time&) {
      if (located.scan.stamp < half) survey.take(std::move(located));
    });
    const mapping::FittedRooms fitted = mapping::fitRooms(survey, {});
    folder_.write("rooms.yaml", mapping::roomsText(fitted));
    const Reference reference(surveyed(true), fitted.poses.back());
    logs::Trajectory inside;
    for (const geometry::StampedPose2& pose : tracked(fitted.poses.front())) {
      if (pose.stamp >= half && reference.isIn(fitted.rooms, pose.stamp)) inside.push_back(pose);
    }
    print(inside, "mapping." + name_ + "_split.");
  }

 private:
  // The adjusted path of a recording, laid over that of its first part.
  class Reference {
   public:
    Reference(const mapping::Survey& survey, const geometry::StampedPose2& end) {
      const auto path = mapping::PathAdjuster(survey.keys(), {}).adjust();
      poses_ = mapping::posesOf(survey.path(), survey.keys(), path.keys);
      T_part_all_ = end.pose * at(end.stamp)->inverse();
    }
    bool isIn(const std::vector<mapping::RoomOutline>& rooms, std::int64_t stamp) const {
      const auto pose = at(stamp);
      return pose && std::any_of(rooms.begin(), rooms.end(), [&](const auto& room) {
               return room.contains((T_part_all_ * *pose).translation());
             });
    }

   private:
    std::optional<geometry::Pose2> at(std::int64_t stamp) const {
      return geometry::poseAt(poses_.begin(), poses_.end(), stamp, 1'000'000'000);
    }
    std::vector<geometry::StampedPose2> poses_;
    geometry::Pose2 T_part_all_;
  };

  template <class Take>
  void read(const pipeline::EstimatorsConfig& config, const Take& take) const {
    bridge::BagFeed feed({folder_.path("in.bag")}, config, {});
    bridge::BagFeed::Visitor visitor;
    visitor.scan = take;
    visitor.message = [](const rosbag::MessageInstance&) {};
    visitor.progress = [](double) {};
    feed.read(visitor);
  }

  mapping::Survey surveyed(bool with_wheels) const {
    auto config = config_;
    if (!with_wheels) config.input.feed.odometry_source = pipeline::OdometrySource::kNone;
    mapping::Survey survey(config);
    read(config,
         [&](pipeline::LocatedScan located, const ros::Time&) { survey.take(std::move(located)); });
    return survey;
  }

  std::int64_t halfTime() const {
    std::vector<std::int64_t> stamps;
    read(config_, [&](const pipeline::LocatedScan& located, const ros::Time&) {
      stamps.push_back(located.scan.stamp);
    });
    return stamps[stamps.size() / 2];
  }

  pipeline::EstimatorsConfig inRooms(const geometry::StampedPose2& start) const {
    auto config = config_;
    config.rooms->map = folder_.path("rooms.yaml");
    config.rooms->initial_pose = start.pose;
    return config;
  }

  // The tracker from a pose on.
  logs::Trajectory tracked(const geometry::StampedPose2& start) const {
    const auto config = inRooms(start);
    bridge::RecordedEstimates estimates(config, {false, true, false}, folder_.path(""));
    read(config, [&](pipeline::LocatedScan located, const ros::Time& now) {
      estimates.take(std::move(located), now);
    });
    estimates.close();
    return logs::readTrajectory(folder_.path("rooms.tum"));
  }

  void print(logs::Trajectory trajectory, const std::string& prefix) const {
    const std::string stamps = folder_.path("in.bag.stamps");
    if (std::filesystem::exists(stamps)) {
      trajectory = logs::atLoggedStamps(trajectory, logs::readStamps(stamps));
    }
    const auto relations = logs::readRelations((data_ / (name_ + ".relations")).string());
    fmt::print("{}",
               logs::figures(logs::compareWithRelations(trajectory, relations, measured_), prefix));
  }

  std::string name_;
  std::filesystem::path data_;
  test::TemporaryFolder folder_;
  pipeline::EstimatorsConfig config_;
  geometry::Pose2 measured_;
};

inline bool hasRecording(const std::string& name) {
  const char* data = std::getenv("SIGHTLINE_DATA");
  const bool is_there =
      data && std::filesystem::exists(std::filesystem::path(data) / (name + ".clf.gz"));
  if (!is_there)
    fmt::print("# mapping.{}: left out, SIGHTLINE_DATA holds no {}.clf.gz\n", name, name);
  return is_there;
}

inline void printRecordings() {
  if (hasRecording("fr079")) {
    bridge::CarmenBagOptions options;
    options.reverse_from_tv = true;
    options.odometry_delay = 0.12;
    const MappedRecording freiburg("fr079", options, "fr079.yaml", {0.04, 0.0, 0.0});
    freiburg.printRooms();
    freiburg.printRoomsWithoutWheels();
    freiburg.printSplit();
    freiburg.printPoses(/*with_wheels=*/true);
    freiburg.printPoses(/*with_wheels=*/false);
  }
  if (hasRecording("intel_part")) {
    MappedRecording("intel_part", {}, "odometry.yaml", {}).printPoses(/*with_wheels=*/true);
  }
}

}  // namespace sightline::bench
