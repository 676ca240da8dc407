#pragma once

#include <cstddef>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"
#include "sightline/tracking/scan_agreement.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// Place in a map from which a scan may have been taken.
struct PoseCandidate {
  geometry::Pose2 T_map_base;
  std::size_t room = 0;
  ScanAgreement agreement;
  double log_likelihood = 0.0;  ///< see logLikelihood
};

struct RelocaliserConfig {
  double cell = 0.1;                 ///< of the grid of positions [m]
  std::size_t most_starts = 300;     ///< positions that are refined
  std::size_t most_beams = 90;       ///< of the scan that are used, evenly spread
  std::size_t most_candidates = 40;  ///< that are returned
  double least_log_ratio = -14.0;    ///< of a candidate's likelihood to the best one's
};

/// Finds where in a map a scan was taken, without any start: the heading modulo 90° from the
/// directions of the walls, for each heading the correlation of what faces the scanner to its four
/// sides with the walls that face that way, a joint refinement of the best places, and a beam model
/// that ranks them. The best candidate comes first; all are apart by more than 0.3 m or 6°. None
/// where scan or map hold no walls.
std::vector<PoseCandidate> relocalise(const world::RoomMap& map, const scan::Scan& scan,
                                      const geometry::Pose2& T_base_sensor,
                                      const RelocaliserConfig& config = {});

/// Whether two poses are within 0.3 m and 6° of each other.
bool areAlike(const geometry::Pose2& a, const geometry::Pose2& b);

}  // namespace sightline::tracking
