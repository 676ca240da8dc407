#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/figures.h"
#include "sightline/bridge/bag_feed.h"
#include "sightline/bridge/bag_from_carmen.h"
#include "sightline/logs/trajectory_error.h"
#include "sightline/pipeline/estimators.h"
#include "temporary_folder.h"

/// The room tracker on the log fr079, whole, against its hand-verified relations.
namespace sightline::bench {

/// One way of tracking the log.
struct FreiburgRun {
  std::string name;
  bool is_repaired = true;  ///< by the options of carmen_to_bag below
  bool has_start = true;    ///< whether the tracker is told the first pose
  bool has_wheels = true;   ///< or goes by the dead reckoning from the scans
};

/// Poses of the scans that have one, and how many of them are flagged.
struct FreiburgPoses {
  logs::Trajectory trajectory;
  std::vector<bool> is_flagged;
};

/// Tracks the log as `offline` does from the bag of `carmen_to_bag`, repaired by
/// `--reverse-from-tv --odometry-delay 0.12`.
inline FreiburgPoses trackFreiburg(const std::string& log, const FreiburgRun& run) {
  const test::TemporaryFolder folder;
  bridge::CarmenBagOptions options;
  options.reverse_from_tv = run.is_repaired;
  options.odometry_delay = run.is_repaired ? 0.12 : 0.0;
  bridge::writeCarmenBag(logs::readCarmenLog(log), options, folder.path("in.bag"));
  auto config =
      pipeline::EstimatorsConfig::readFile(SIGHTLINE_SOURCE_DIR "/config/offline/fr079.yaml");
  if (!run.has_start) config.rooms->initial_pose.reset();
  if (!run.has_wheels) config.input.feed.odometry_source = pipeline::OdometrySource::kNone;
  bridge::BagFeed feed({folder.path("in.bag")}, config, {});
  pipeline::Estimators estimators(config, {false, true, !run.has_wheels});
  FreiburgPoses poses;
  bridge::BagFeed::Visitor visitor;
  visitor.scan = [&](pipeline::LocatedScan located, const ros::Time&) {
    const auto update = estimators.take(std::move(located)).rooms;
    if (!update) return;
    poses.trajectory.push_back({update->stamp, update->pose.mean});
    poses.is_flagged.push_back(update->state != tracking::TrackerState::kTracking);
  };
  visitor.message = [](const rosbag::MessageInstance&) {};
  visitor.progress = [](double) {};
  feed.read(visitor);
  return poses;
}

/// The figures of the scans from one share of the log's time to another.
inline void printPart(const FreiburgPoses& poses, const std::vector<logs::Relation>& relations,
                      const std::string& name, double from, double to) {
  const auto& trajectory = poses.trajectory;
  const std::int64_t first = trajectory.front().stamp;
  const auto duration = static_cast<double>(trajectory.back().stamp - first);
  const auto isWithin = [&](std::int64_t stamp) {
    const double share = static_cast<double>(stamp - first) / duration;
    return share >= from && share <= to;
  };
  std::vector<logs::Relation> within;
  std::copy_if(relations.begin(), relations.end(), std::back_inserter(within),
               [&](const auto& r) { return isWithin(r.first) && isWithin(r.second); });
  double scans = 0.0;
  double flagged = 0.0;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (!isWithin(trajectory[i].stamp)) continue;
    scans += 1.0;
    flagged += poses.is_flagged[i] ? 1.0 : 0.0;
  }
  // The relations hold 4 cm ahead of the point that scans and odometry share.
  const geometry::Pose2 T_base_measured(0.04, 0.0, 0.0);
  const auto errors = logs::compareWithRelations(trajectory, within, T_base_measured);
  fmt::print("{}", logs::figures(errors, name + "."));
  print(name + ".flagged_percent", 100.0 * flagged / std::max(1.0, scans), "%");
}

/// Prints rooms.fr079*, or says that the log is not there. Constants of the tracker are chosen by
/// its first half: the second is held out.
inline void printFreiburg() {
  const char* data = std::getenv("SIGHTLINE_DATA");
  const std::filesystem::path folder = data ? data : "";
  if (!data || !std::filesystem::exists(folder / "fr079.clf.gz")) {
    fmt::print("# rooms.fr079: left out, SIGHTLINE_DATA holds no fr079.clf.gz\n");
    return;
  }
  const auto relations = logs::readRelations((folder / "fr079.relations").string());
  for (const FreiburgRun& run : {FreiburgRun{"fr079"}, FreiburgRun{"fr079_raw", false},
                                 FreiburgRun{"fr079_no_start", true, false},
                                 FreiburgRun{"fr079_laser_only", true, true, false}}) {
    const auto poses = trackFreiburg((folder / "fr079.clf.gz").string(), run);
    printPart(poses, relations, "rooms." + run.name, 0.0, 1.0);
    printPart(poses, relations, "rooms." + run.name + ".first_half", 0.0, 0.5);
    printPart(poses, relations, "rooms." + run.name + ".second_half", 0.5, 1.0);
  }
}

}  // namespace sightline::bench
