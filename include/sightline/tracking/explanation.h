#pragma once

#include <cstddef>
#include <vector>

#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/pose_filter.h"
#include "sightline/tracking/scan_agreement.h"
#include "sightline/tracking/tracking_context.h"
#include "sightline/tracking/wall_fit.h"

namespace sightline::tracking {

/// One way of explaining a scan: the pose before it, corrected by the walls found from there.
struct Explanation {
  PoseFilter filter;
  std::vector<WallUpdate> walls;
  ScanAgreement agreement;
  double log_posterior = 0.0;  ///< up to a constant: prior, beams and walls
  double log_repeats = 0.0;    ///< part of it by beams that repeat what others on a wall say
  /// What the robot is taken to have done since the last scan.
  enum class Motion { kWheels, kCoasting, kSlip, kUnknown } motion = Motion::kWheels;
  bool may_have_slipped = false;  ///< as likely as not, but not so that the pose may be moved
};

/// Walls of a room, and of those behind its doors.
std::vector<world::WallIndex> wallsInSight(const TrackingContext& context, std::size_t room);
/// Corrects a pose by the walls that were found, the best-seen first; says which were refused.
void applyWalls(const TrackingContext& context, const scan::ScanGeometry& geometry,
                PoseFilter& filter, std::vector<WallUpdate>& walls);
/// Corrects it by the jambs of a room's doors, after the walls have told how the robot stands.
void applyJambs(const TrackingContext& context, std::size_t room, const Sweep& sweep,
                PoseFilter& filter);

/// Independent statements that beams on walls make.
double supportOf(const ScanAgreement& agreement, const scan::ScanGeometry& geometry);
/// Share of the beams on walls of the map that belong to no wall that corrected the pose.
double unusedShare(const Explanation& explanation);
/// Whether walls that are well seen were refused for the most part: gates must not lock out for
/// ever what contradicts a wrong prediction.
bool areWallsRefused(const std::vector<WallUpdate>& walls);
/// Sum of the normalised innovations squared of the walls that corrected the pose.
double nisOf(const std::vector<WallUpdate>& walls);

}  // namespace sightline::tracking
