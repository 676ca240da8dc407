#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
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
    print(tracked(fitted.poses.front(), 0), "mapping." + name_ + ".");
  }

  /// Fits rooms to the first half, and tracks the second where it passes the same rooms.
  void printSplit() const {
    const std::int64_t half = halfTime();
    mapping::Survey survey(config_);
    read(config_, [&](pipeline::LocatedScan located, const ros::Time&) {
      if (located.scan.stamp < half) survey.take(std::move(located));
    });
    const mapping::FittedRooms fitted = mapping::fitRooms(survey, {});
    folder_.write("rooms.yaml", mapping::roomsText(fitted));
    logs::Trajectory inside;
    for (const geometry::StampedPose2& pose : tracked(fitted.poses.back(), half)) {
      const bool is_inside =
          std::any_of(fitted.rooms.begin(), fitted.rooms.end(),
                      [&](const auto& room) { return room.contains(pose.pose.translation()); });
      if (is_inside) inside.push_back(pose);
    }
    print(inside, "mapping." + name_ + "_split.");
  }

 private:
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

  // The tracker from a pose on, over the scans from a time on.
  logs::Trajectory tracked(const geometry::StampedPose2& start, std::int64_t from) const {
    auto config = config_;
    config.rooms->map = folder_.path("rooms.yaml");
    config.rooms->initial_pose = start.pose;
    bridge::RecordedEstimates estimates(config, {false, true, false}, folder_.path(""));
    read(config, [&](pipeline::LocatedScan located, const ros::Time& now) {
      if (located.scan.stamp >= from) estimates.take(std::move(located), now);
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
    freiburg.printSplit();
    freiburg.printPoses(/*with_wheels=*/true);
    freiburg.printPoses(/*with_wheels=*/false);
  }
  if (hasRecording("intel_part")) {
    MappedRecording("intel_part", {}, "odometry.yaml", {}).printPoses(/*with_wheels=*/true);
  }
}

}  // namespace sightline::bench
