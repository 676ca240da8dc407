#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/rooms/disturbances.h"
#include "bench/rooms/room_figures.h"
#include "two_rooms.h"

/// Two rooms of 8x6 and 5x6 m joined by a door of 0.9 m, 120 s at 0.4 m/s, 361 beams over 180° at
/// 10 Hz to 8 m with 1 cm of noise, the laser 0.1 m ahead, odometry 2 % short with drift on top.
namespace sightline::bench {

constexpr double kScanPeriod = 0.1;   // [s]
constexpr double kHalfTime = 60.0;    // [s]
constexpr double kKidnapTime = 85.0;  // in the west room [s]

struct TwoRoomRun {
  std::string name;
  std::function<void(RecordedDrive&, std::uint64_t seed)> disturb = [](auto&, auto) {};
  std::optional<geometry::UncertainPose2> start;  // nothing: no start pose
  bool map_is_exact = false;                      // and the tracker is told so
  bool map_is_off = false;                        // walls by 10 mm and 4 mrad
  bool stands = false;
};

inline geometry::UncertainPose2 startAt(const geometry::Pose2& pose, double position_sigma = 0.3,
                                        double heading_sigma = 0.1) {
  const double position = position_sigma * position_sigma;
  return {pose, Eigen::Vector3d(position, position, heading_sigma * heading_sigma).asDiagonal()};
}

inline const geometry::Pose2 kStart(-2.0, 1.0, -1.5);

/// A rectangle of (size, centre) whose sides are off by 10 mm and 4 mrad (one sigma each).
inline std::vector<Eigen::Vector2d> cornersOff(const Eigen::Vector2d& size,
                                               const Eigen::Vector2d& centre,
                                               std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> sides;  // n·p = c
  for (int i = 0; i < 4; ++i) {
    const double angle = 0.5 * geometry::kPi * (i - 1);
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d middle =
        centre + 0.5 * size.cwiseProduct(out) + 0.01 * normal(random) * out;
    const double turned = angle + 0.004 * normal(random);
    const Eigen::Vector2d n(std::cos(turned), std::sin(turned));
    sides.emplace_back(n.x(), n.y(), -n.dot(middle));
  }
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < 4; ++i) corners.push_back(sides[(i + 3) % 4].cross(sides[i]).hnormalized());
  return corners;
}

inline world::RoomMap twoRoomsOff(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  world::RoomMap map;
  const auto east = map.addPolygon("east", cornersOff({5.0, 6.0}, {6.6, 0.0}, random));
  const auto west = map.addPolygon("west", cornersOff({8.0, 6.0}, {0.0, 0.0}, random));
  map.addDoor(west, east, {4.05, 0.5}, 0.9);
  return map;
}

/// The drive without anything going wrong.
inline DriveSetup twoRoomsSetup() {
  DriveSetup setup;
  setup.world = world::World::of(test::twoRooms());
  setup.start = kStart;
  setup.path = simulation::Path(config::Node::parse(test::kTwoRoomsPath, "path"));
  setup.scanner = test::scannerProfile({});
  setup.T_base_sensor = {0.1, 0.0, 0.0};
  setup.robot = test::robotConfig();
  setup.seconds = test::kTwoRoomsSeconds;
  return setup;
}

class TwoRoomRuns {
 public:
  explicit TwoRoomRuns(int seeds) : seeds_(seeds) {}

  RoomFigures figures(const TwoRoomRun& run) {
    RoomFigures figures;
    for (int seed = 1; seed <= seeds_; ++seed) figures.add(trackedBy(run, seed), kScanPeriod);
    return figures;
  }

  std::vector<TrackedScan> trackedBy(const TwoRoomRun& run, int seed) {
    RecordedDrive drive = driveOf(run, seed);
    run.disturb(drive, static_cast<std::uint64_t>(seed));
    tracking::TrackerConfig config;
    if (run.map_is_exact) config.wall.position_sigma = config.wall.direction_sigma = 0.0;
    tracking::RoomTracker tracker(config, test::twoRooms());
    if (run.start) tracker.setPose(*run.start);
    auto scans = Playback(tracker, twoRoomsSetup().T_base_sensor).play(drive);
    calibration_.add(scans, kScanPeriod);
    return scans;
  }

  /// The drive that begins in the east room, to be kidnapped to.
  const RecordedDrive& eastern(int seed) {
    return recorded("east", seed, [](DriveSetup& setup) {
      setup.start = {8.0, -1.0, 2.0};
      setup.path.waypoints_map = {{8, 2},  {6, 2},  {6, -2}, {8, -2},  {8, 1},   {6, 0.5},
                                  {8, 2},  {6, 2},  {6, -2}, {8, -2},  {8, 2},   {6, 2},
                                  {6, -2}, {8, -2}, {8, 1},  {6, 0.5}, {2, 0.5}, {-2, 2}};
    });
  }
  /// The drive on from half time, the robot having been turned on the spot by an angle [rad].
  const RecordedDrive& turned(int seed, double angle) {
    const RecordedDrive& before = recorded("clean", seed, [](DriveSetup&) {});
    const auto stamp = static_cast<std::int64_t>(kHalfTime * 1e9);
    return recorded(fmt::format("turned {:.3f}", angle), seed, [&](DriveSetup& setup) {
      setup.begin = kHalfTime;
      setup.seconds = test::kTwoRoomsSeconds - kHalfTime;
      setup.start = before.truth.at(stamp).value() * geometry::Pose2(0.0, 0.0, angle);
      dropPassed(before, stamp, setup.path);
    });
  }
  const QualityCalibration& calibration() const { return calibration_; }

 private:
  // Leaves those waypoints that a drive has still before it.
  static void dropPassed(const RecordedDrive& drive, std::int64_t stamp, simulation::Path& path) {
    auto next = path.waypoints_map.begin();
    for (std::int64_t time = 0; time < stamp; time += 20'000'000) {
      const auto pose = drive.truth.at(time);
      const bool is_there = pose && (pose->translation() - *next).norm() < path.tolerance + 0.01;
      if (is_there) ++next;
    }
    path.waypoints_map.erase(path.waypoints_map.begin(), next);
  }

  const RecordedDrive& driveOf(const TwoRoomRun& run, int seed) {
    if (!run.map_is_off && !run.stands) return recorded("clean", seed, [](DriveSetup&) {});
    const std::string key = run.stands ? "standing" : "off";
    return recorded(key, seed, [&](DriveSetup& setup) {
      setup.world = world::World::of(twoRoomsOff(static_cast<std::uint64_t>(seed)));
      if (!run.stands) return;
      setup.path.wait = 1e6;
      setup.seconds = 600.0;
      setup.start = {-3.0 + 0.3 * seed, -2.0 + 0.2 * seed, 0.7 * seed};
    });
  }

  const RecordedDrive& recorded(const std::string& key, int seed,
                                const std::function<void(DriveSetup&)>& change) {
    const auto found = drives_.find({key, seed});
    if (found != drives_.end()) return found->second;
    DriveSetup setup = twoRoomsSetup();
    change(setup);
    return drives_
        .emplace(std::make_pair(key, seed), recordDrive(setup, static_cast<std::uint64_t>(seed)))
        .first->second;
  }

  int seeds_;
  std::map<std::pair<std::string, int>, RecordedDrive> drives_;
  QualityCalibration calibration_;
};

}  // namespace sightline::bench
