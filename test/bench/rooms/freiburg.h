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

/// One way of tracking the log.
struct FreiburgRun {
  std::string name;
  bool is_repaired = true;  ///< by the options of carmen_to_bag below
  bool has_start = true;    ///< whether the tracker is told the first pose
};

/// The pose for each scan that has one, as `offline` writes it from the bag of `carmen_to_bag`,
/// repaired by `--reverse-from-tv --odometry-delay 0.12`.
inline logs::Trajectory trackFreiburg(const std::string& log, const FreiburgRun& run) {
  const test::TemporaryFolder folder;
  bridge::CarmenBagOptions options;
  options.reverse_from_tv = run.is_repaired;
  options.odometry_delay = run.is_repaired ? 0.12 : 0.0;
  bridge::writeCarmenBag(logs::readCarmenLog(log), options, folder.path("in.bag"));
  auto config =
      pipeline::EstimatorsConfig::readFile(SIGHTLINE_SOURCE_DIR "/config/offline/fr079.yaml");
  if (!run.has_start) config.rooms->initial_pose.reset();
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
  for (const std::string& line : estimates.summary()) fmt::print("# {}: {}\n", run.name, line);
  return logs::readTrajectory(folder.path("rooms.tum"));
}

/// Prints rooms.fr079*, or says that the log is not there.
inline void printFreiburg() {
  const char* data = std::getenv("SIGHTLINE_DATA");
  const std::filesystem::path folder = data ? data : "";
  if (!data || !std::filesystem::exists(folder / "fr079.clf.gz")) {
    fmt::print("# rooms.fr079: left out, SIGHTLINE_DATA holds no fr079.clf.gz\n");
    return;
  }
  // The relations hold 4 cm ahead of the point that scans and odometry share.
  const geometry::Pose2 T_base_measured(0.04, 0.0, 0.0);
  const auto relations = logs::readRelations((folder / "fr079.relations").string());
  for (const FreiburgRun& run : {FreiburgRun{"fr079"}, FreiburgRun{"fr079_raw", false},
                                 FreiburgRun{"fr079_no_start", true, false}}) {
    const auto errors = logs::compareWithRelations(
        trackFreiburg((folder / "fr079.clf.gz").string(), run), relations, T_base_measured);
    fmt::print("{}", logs::figures(errors, "rooms." + run.name + "."));
  }
}

}  // namespace sightline::bench
