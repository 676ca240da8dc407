#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "bench/rooms/playback.h"
#include "bench/rooms/room_figures.h"
#include "sightline/tracking/relocaliser.h"

/// Starts without a pose on the shipped floor: from a random place in a room to its door, then
/// along the corridor. 361 beams over 180° at 10 Hz to 20 m, 1 cm of noise, 0.4 m above ground.
namespace sightline::bench {

class FloorStarts {
 public:
  /// @param name  of the figures
  FloorStarts(std::string name, world::World world)
      : name_(std::move(name)),
        map_(world::RoomMap::readFile(SIGHTLINE_SOURCE_DIR "/config/rooms/floor.yaml")),
        world_(std::move(world)) {}

  /// Prints how many are right, and claimed, 10 s after the door, and how many claim a wrong pose
  /// at any time.
  void print(int starts) {
    int successes = 0;
    int false_claims = 0;
    for (int seed = 1; seed <= starts; ++seed) {
      const RecordedDrive drive = driveFrom(static_cast<std::uint64_t>(seed));
      tracking::RoomTracker tracker({}, map_);
      const auto scans = Playback(tracker, {}).play(drive);
      const auto is_false = [](const TrackedScan& scan) {
        return scan.isClaimed() && !scan.isRight();
      };
      successes += scans.back().isClaimed() && scans.back().isRight() ? 1 : 0;
      false_claims += std::any_of(scans.begin(), scans.end(), is_false) ? 1 : 0;
    }
    bench::print(name_ + ".success", 100.0 * successes / starts, "%");
    bench::print(name_ + ".false_claims", 100.0 * false_claims / starts, "%");
    bench::print("rooms.relocalise_ms", median(searches_), "ms");
  }

 private:
  RecordedDrive driveFrom(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const world::Door& door = map_.doors()[seed % map_.doors().size()];
    const std::size_t room = map_.rooms()[door.rooms[0]].name == "corridor" ? 1 : 0;
    const Eigen::Vector2d inwards =
        map_.wall({door.rooms[room], door.walls[room]}).segment.leftNormal();
    DriveSetup setup;
    setup.world = world_;
    const Eigen::Vector2d before = door.centre_map + 0.9 * inwards;
    setup.start = freeStart(map_.rooms()[door.rooms[room]], before, random);
    const Eigen::Vector2d corridor(door.centre_map.x(), 0.0);
    setup.path.speed = 0.4;
    setup.path.waypoints_map = {before, door.centre_map - 0.5 * inwards, corridor,
                                corridor - Eigen::Vector2d(8.0, 0.0)};
    setup.scanner.beams = 361;
    setup.scanner.angle_min = -0.5 * geometry::kPi;
    setup.scanner.angle_max = 0.5 * geometry::kPi;
    setup.scanner.range_max = 20.0;
    setup.scanner.rate = 10.0;
    setup.scanner.noise.sigma = 0.01;
    setup.height = 0.4;
    const double way = (setup.start.translation() - before).norm() + 1.4;
    setup.seconds = way / setup.path.speed + 6.0 + 10.0;
    RecordedDrive drive = recordDrive(setup, seed);
    timeSearch(drive.sweeps.front().scan);
    return drive;
  }

  void timeSearch(const scan::Scan& scan) {
    const double begin = threadTime();
    tracking::relocalise(map_, scan, {});
    searches_.push_back(1e3 * (threadTime() - begin));
  }

  // A place from which the way to the door is free.
  geometry::Pose2 freeStart(const world::Room& room, const Eigen::Vector2d& door,
                            std::mt19937_64& random) const {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const Eigen::Vector2d low = room.walls[0].segment.start;
    const Eigen::Vector2d extent = room.walls[2].segment.start - low;
    while (true) {
      const Eigen::Vector2d at =
          low + extent.cwiseProduct(Eigen::Vector2d(unit(random), unit(random)));
      const double heading = 2.0 * geometry::kPi * unit(random);
      bool is_free = true;
      for (double share = 0.0; share <= 1.0; share += 0.05) {
        is_free = is_free && hasRoom((1.0 - share) * at + share * door);
      }
      if (is_free) return {at, heading};
    }
  }

  bool hasRoom(const Eigen::Vector2d& at) const {
    for (int i = 0; i < 24; ++i) {
      const double angle = geometry::kPi / 12.0 * i;
      const world::Ray ray{{at.x(), at.y(), 0.4}, {std::cos(angle), std::sin(angle), 0.0}};
      const auto hit = world_.cast(ray);
      if (hit && hit->range < 0.35) return false;
    }
    return true;
  }

  std::string name_;
  world::RoomMap map_;
  world::World world_;
  std::vector<double> searches_;  // [ms]
};

inline void printFloorStarts(int starts) {
  const auto map = world::RoomMap::readFile(SIGHTLINE_SOURCE_DIR "/config/rooms/floor.yaml");
  FloorStarts("rooms.bootstrap.bare", world::World::of(map)).print(starts);
  FloorStarts("rooms.bootstrap.furnished",
              world::World::readFile(SIGHTLINE_SOURCE_DIR "/config/worlds/floor.yaml"))
      .print(starts);
}

}  // namespace sightline::bench
