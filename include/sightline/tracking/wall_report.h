#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sightline/tracking/tracker_update.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// Use of one wall of the map over a run.
struct WallUse {
  std::string room;
  std::string wall;
  std::size_t fitted = 0;    ///< scans in which a line was fitted to it
  std::size_t used = 0;      ///< those in which it corrected the pose
  double mean_offset = 0.0;  ///< of the lines from where the map has it, into the room [m]
  double std_offset = 0.0;   ///< standard deviation of it over the scans [m]

  /// Whether it is off by so much, or was refused more often than not.
  bool isSuspect(double offset) const;
};

/// Collects where the scans see the walls, against where the map has them: after each update, by
/// the pose that all walls together gave. Scans that are flagged are left out.
class WallReport {
 public:
  void add(const TrackerUpdate& update, const world::RoomMap& map);
  void clear() { sums_.clear(); }
  /// The walls that were seen, in the order of the map.
  std::vector<WallUse> uses(const world::RoomMap& map) const;

 private:
  struct Sums {
    std::size_t fitted = 0;
    std::size_t used = 0;
    double offset = 0.0;
    double square = 0.0;
  };

  std::map<std::pair<std::size_t, std::size_t>, Sums> sums_;  // by room and wall
};

}  // namespace sightline::tracking
