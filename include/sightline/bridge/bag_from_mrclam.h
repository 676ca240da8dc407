#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/logs/mrclam.h"

namespace sightline::bridge {

/// What to mend in a set, and errors to add to its poses.
struct MrclamBagOptions {
  double lag = 0.0;     ///< stamps of looks come so late [s]
  double bias = 0.0;    ///< measured less true bearing, of all robots [rad]
  double period = 0.0;  ///< between two images [s]; 0: found in the log; negative: leave them out
  double from = 0.0;    ///< time after the beginning of the set at which the bag begins [s]
  double to = 1e6;      ///< and ends [s]
  double position_sigma = 0.0;    ///< error of the poses, in x and in y [m]
  double heading_sigma = 0.0;     ///< [rad]
  double pose_correlation = 0.0;  ///< time constant of these errors [s]; 0: each on its own
  int seed = 1;                   ///< of these errors

  void visit(config::FieldVisitor& visitor);
};

struct MrclamBagContents {
  std::size_t looks = 0;
  std::size_t empty = 0;  ///< of these, put back
  std::size_t bearings = 0;
  std::size_t poses = 0;
  std::vector<std::string> robots;  ///< namespaces
};

/// Writes for each robot ROBOT/bearings (a set a look, ranges and identities left out), ROBOT/pose
/// (of the camera, from outside), ROBOT/odom; beside the bag, for scoring, PATH.truth.csv
/// (`kind,id,x,y`), PATH.ROBOT.tum and PATH.labels.csv (`stamp,robot,index,subject`). Throws
/// config::Error.
MrclamBagContents writeMrclamBag(const logs::MrclamSet& set, const MrclamBagOptions& options,
                                 const std::string& path);

}  // namespace sightline::bridge
