#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bench/rooms/playback.h"
#include "bench/rooms/room_figures.h"

/// The experiments of jensfelt section 5 in simulation: his scanner at 3 Hz and 0.93 m above
/// ground, of which walls beyond 15 m give no answer, as in his corridor; the odometry of his
/// appendix; rooms with furniture that the map knows nothing of. Both methods are as shipped.
namespace sightline::bench {

constexpr double kPlsPeriod = 1.0 / 3.0;  // [s]

/// One of his runs.
struct PaperRun {
  std::string name;
  std::string world;  ///< of config/worlds
  std::string rooms;  ///< of config/rooms, that the world is built on
  geometry::Pose2 start;
  std::vector<Eigen::Vector2d> waypoints;
  double seconds = 0.0;
  /// Whether a place is in the corridor, where what counts is the stated uncertainty along x.
  std::function<bool(const geometry::Pose2&)> is_in_corridor = [](const auto&) { return false; };
};

inline simulation::ScannerProfile plsProfile() {
  auto profile =
      simulation::ScannerProfile::readFile(SIGHTLINE_SOURCE_DIR "/config/sensors/sick_pls200.yaml");
  profile.range_max = 15.0;
  return profile;
}

/// The drive of one seed; which of the waypoints come again and again is left to the run.
inline RecordedDrive driveOf(const PaperRun& run, std::uint64_t seed) {
  DriveSetup setup;
  setup.world =
      world::World::readFile(SIGHTLINE_SOURCE_DIR "/config/worlds/" + run.world + ".yaml");
  setup.start = run.start;
  setup.path.speed = 0.4;
  setup.path.repeat = true;
  setup.path.waypoints_map = run.waypoints;
  setup.scanner = plsProfile();
  setup.height = 0.93;
  setup.seconds = run.seconds;
  return recordDrive(setup, seed);
}

/// Tracks a drive from its true start, said to be as uncertain as starts are by default.
inline std::vector<TrackedScan> trackedBy(const PaperRun& run, const RecordedDrive& drive,
                                          const tracking::TrackerConfig& config) {
  tracking::RoomTracker tracker(
      config,
      world::RoomMap::readFile(SIGHTLINE_SOURCE_DIR "/config/rooms/" + run.rooms + ".yaml"));
  tracker.setPose({run.start, Eigen::Vector3d(0.09, 0.09, 0.01).asDiagonal()});
  return Playback(tracker, {}).play(drive);
}

/// Within 0.10 m and 2°; along the corridor within four of its sigmas, and 1 m.
inline bool isSuccess(const PaperRun& run, const TrackedScan& scan) {
  if (!scan.has_pose || scan.heading_error > geometry::radians(2.0)) return false;
  if (!run.is_in_corridor(scan.truth)) return scan.position_error <= 0.10;
  const double along = std::min(1.0, 4.0 * std::sqrt(scan.covariance(0, 0)));
  return std::abs(scan.error.y()) <= 0.10 && std::abs(scan.error.x()) <= along;
}

/// The error along the corridor against its variance, over all scans of a run.
inline double neesAlong(const std::vector<TrackedScan>& scans) {
  double sum = 0.0;
  for (const TrackedScan& scan : scans) {
    if (scan.has_pose) sum += scan.error.x() * scan.error.x() / scan.covariance(0, 0);
  }
  return sum / std::max(1.0, static_cast<double>(scans.size()));
}

/// Whether a pose is off by the depth of a shelf for more than 2 s.
inline bool isLockedIn(const std::vector<TrackedScan>& scans) {
  double seconds = 0.0;
  for (const TrackedScan& scan : scans) {
    seconds = scan.has_pose && scan.position_error > 0.2 ? seconds + kPlsPeriod : 0.0;
    if (seconds > 2.0) return true;
  }
  return false;
}

inline PaperRun livingRoom() {
  return {"living_room",
          "jensfelt_living_room",
          "living_room",
          {-0.8, 0.6, 2.8},
          {{-3.2, 1.4}, {0.8, 1.5}, {0.8, -1.2}, {3.6, -0.9}, {0.6, -0.6}, {-0.8, 0.6}},
          250.0};
}

inline PaperRun office() {
  return {"office",
          "office",
          "office",
          {1.1, -0.9, 2.0},
          {{0.4, 0.7}, {0.4, -0.9}, {-1.1, -0.8}, {0.4, -1.0}, {1.1, -0.9}},
          250.0};
}

inline PaperRun corridor() {
  return {"corridor",
          "corridor",
          "corridor",
          {-25.5, 0.0, 0.0},
          {{25.5, 0.0}, {-25.5, 0.0}},
          290.0,
          [](const geometry::Pose2&) { return true; }};
}

inline PaperRun livingRoomToLab() {
  return {"living_room_to_lab",
          "long_floor",
          "long_floor",
          {-19.9, 4.6, 0.2},
          {{-17.4, 4.9},
           {-16.5, 3.6},
           {-17.0, 2.0},
           {-17.0, 1.0},
           {-16.2, 0.0},
           {18.9, 0.0},
           {19.9, -0.7},
           {20.0, -2.4},
           {19.2, -4.6},
           {17.7, -5.7},
           {15.7, -5.3},
           {15.5, -3.6},
           {17.1, -2.9}},
          150.0,
          [](const geometry::Pose2& truth) { return std::abs(truth.y()) < 1.21; }};
}

/// From the corridor into the living room, whose bookshelf and pillar stand in a line before a
/// wall: the uncertainty of the threshold opens the gates (jensfelt section 5.2).
inline PaperRun bookshelf() {
  return {"bookshelf",
          "long_floor",
          "long_floor",
          {-13.0, 0.0, geometry::kPi},
          {{-16.2, 0.0}, {-17.0, 1.0}, {-17.0, 2.4}, {-18.5, 4.6}, {-17.0, 4.9}, {-17.0, 2.4}},
          90.0};
}

class PaperRuns {
 public:
  explicit PaperRuns(int seeds) : seeds_(seeds) {}

  /// Prints how many runs succeed, by the default method and by the one that the paper describes.
  void printSuccess(const PaperRun& run) const {
    int successes = 0;
    int plain_successes = 0;
    double nees = 0.0;
    for (int seed = 1; seed <= seeds_; ++seed) {
      const RecordedDrive drive = driveOf(run, static_cast<std::uint64_t>(seed));
      const auto scans = trackedBy(run, drive, {});
      successes += areSuccessful(run, scans) ? 1 : 0;
      plain_successes += areSuccessful(run, trackedBy(run, drive, plain())) ? 1 : 0;
      nees += neesAlong(scans) / seeds_;
    }
    print("rooms." + run.name + ".success", 100.0 * successes / seeds_, "%");
    print("rooms." + run.name + ".plain_success", 100.0 * plain_successes / seeds_, "%");
    if (run.is_in_corridor(run.start)) print("rooms." + run.name + ".nees_along", nees, "1");
  }

  /// Prints how many of a hundred runs take a shelf for the wall behind it.
  void printLockIns(const std::string& name, const PaperRun& run) const {
    int locked_in = 0;
    int plain_locked_in = 0;
    for (int seed = 1; seed <= seeds_; ++seed) {
      const RecordedDrive drive = driveOf(run, static_cast<std::uint64_t>(seed));
      locked_in += isLockedIn(trackedBy(run, drive, {})) ? 1 : 0;
      plain_locked_in += isLockedIn(trackedBy(run, drive, plain())) ? 1 : 0;
    }
    print("rooms." + name + ".plain_locked_in", 100.0 * plain_locked_in / seeds_, "%");
    print("rooms." + name + ".locked_in", 100.0 * locked_in / seeds_, "%");
  }

 private:
  static tracking::TrackerConfig plain() {
    tracking::TrackerConfig config;
    config.method = tracking::Method::kPlain;
    return config;
  }

  static bool areSuccessful(const PaperRun& run, const std::vector<TrackedScan>& scans) {
    return !scans.empty() && std::all_of(scans.begin(), scans.end(), [&](const TrackedScan& scan) {
      return isSuccess(run, scan);
    });
  }

  int seeds_;
};

inline void printPaperRuns(int seeds) {
  const PaperRuns runs(seeds);
  runs.printSuccess(livingRoom());
  runs.printSuccess(office());
  runs.printSuccess(corridor());
  runs.printSuccess(livingRoomToLab());
  runs.printLockIns("bookshelf", bookshelf());
  runs.printLockIns("office_shelf", office());
}

}  // namespace sightline::bench
