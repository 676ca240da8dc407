#pragma once

#include <cstdint>
#include <string>

#include "monte_carlo.h"
#include "sightline/scan/noise_model.h"
#include "sightline/scan/scan.h"
#include "sightline/simulation/scanner.h"
#include "sightline/world/room_map.h"
#include "sightline/world/world.h"

namespace sightline::test {

/// Rooms whose walls are the world, and a scanner in them that takes all beams at once.
class SimulatedRooms {
 public:
  explicit SimulatedRooms(const std::string& rooms, unsigned seed = 1,
                          const simulation::ScannerProfile& scanner = profile())
      : map(config::Node::parse(rooms, "rooms")),
        world(world::World::of(map)),
        scanner_(scanner, {}, seed) {}

  scan::Scan look(const geometry::Pose2& T_map_sensor, std::int64_t stamp) {
    return scanner_.sweep(world, stamp, [&](std::int64_t) { return T_map_sensor; });
  }

  static simulation::ScannerProfile profile() {
    simulation::ScannerProfile profile;
    profile.beams = 361;
    profile.angle_min = geometry::radians(-135.0);
    profile.angle_max = geometry::radians(135.0);
    profile.range_max = 20.0;
    profile.revolution = 0.0;
    profile.resolution = 0.0;
    profile.noise.sigma = 0.01;
    return profile;
  }

  world::RoomMap map;
  world::World world;

 private:
  simulation::Scanner scanner_;
};

}  // namespace sightline::test
