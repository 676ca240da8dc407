#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "sightline/bridge/bag_feed.h"
#include "sightline/bridge/bag_from_carmen.h"
#include "sightline/bridge/recorded_estimates.h"
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
      pipeline::EstimatorsConfig::readFile(SIGHTLINE_SOURCE_DIR "/config/offline/fr079.yaml");
  bridge::BagFeed feed({folder.path("in.bag")}, config, {});
  bridge::RecordedEstimates estimates(config, {false, true, false}, folder.path(""));
  bridge::BagFeed::Visitor visitor;
  visitor.scan = [&](pipeline::LocatedScan located, const ros::Time& now) {
    estimates.take(std::move(located), now);
  };
  visitor.message = [](const rosbag::MessageInstance&) {};
  visitor.progress = [](double) {};
  feed.read(visitor);
  estimates.close();
  for (const std::string& line : estimates.summary()) fmt::print("# fr079: {}\n", line);
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
