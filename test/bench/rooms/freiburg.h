#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <rosbag/bag.h>

#include "sightline/bridge/bag_estimators.h"
#include "sightline/bridge/bag_from_carmen.h"
#include "sightline/logs/trajectory_error.h"
#include "temporary_folder.h"

/// The room tracker on the log fr079, whole, against its hand-verified relations.
namespace sightline::bench {

/// The pose for each scan that has one, as `offline` writes it from the bag of `carmen_to_bag
/// --reverse-from-tv --odometry-delay 0.12`.
inline logs::Trajectory trackFreiburg(const std::string& log) {
  const test::TemporaryFolder folder;
  bridge::CarmenBagOptions options;
  options.reverse_from_tv = true;
  options.odometry_delay = 0.12;
  bridge::writeCarmenBag(logs::readCarmenLog(log), options, folder.path("in.bag"));
  const auto config =
      pipeline::OfflineConfig::readFile(SIGHTLINE_SOURCE_DIR "/config/offline/fr079.yaml");
  bridge::BagScans scans(folder.path("in.bag"), config, true);
  rosbag::Bag out(folder.path("out.bag"), rosbag::bagmode::Write);
  bridge::BagRooms rooms(config, out, folder.path("rooms.tum"));
  bridge::BagScans::Visitor visitor;
  visitor.scan = [&](const bridge::LocatedScan& located, const ros::Time& now) {
    rooms.process(located, now);
  };
  visitor.message = [](const rosbag::MessageInstance&) {};
  visitor.progress = [](double) {};
  scans.read(visitor);
  rooms.finish();
  for (const std::string& line : rooms.summary()) fmt::print("# fr079: {}\n", line);
  return logs::readTrajectory(folder.path("rooms.tum"));
}

/// Prints rooms.fr079.*, or says that the log is not there.
inline void printFreiburg() {
  const char* data = std::getenv("SIGHTLINE_DATA");
  const std::filesystem::path folder = data ? data : "";
  if (!data || !std::filesystem::exists(folder / "fr079.clf.gz")) {
    fmt::print("# rooms.fr079: left out, SIGHTLINE_DATA holds no fr079.clf.gz\n");
    return;
  }
  // The relations hold 4 cm ahead of the point that scans and odometry share.
  const geometry::Pose2 T_base_measured(0.04, 0.0, 0.0);
  const auto errors = logs::compareWithRelations(
      trackFreiburg((folder / "fr079.clf.gz").string()),
      logs::readRelations((folder / "fr079.relations").string()), T_base_measured);
  fmt::print("{}", logs::figures(errors, "rooms.fr079."));
}

}  // namespace sightline::bench
