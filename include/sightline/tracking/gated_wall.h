#pragma once

#include <vector>

#include "sightline/fitting/line_fit.h"
#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/tracker_config.h"
#include "sightline/tracking/validation_gate.h"
#include "sightline/tracking/wall_fit.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// The validated beams of one wall.
struct GatedWall {
  ValidationGate gate;
  std::vector<const BeamPoint*> points;
};

/// Puts each beam into the gates that it lies in, one for each wall (jensfelt section 4.2, step 1).
/// Walls that are open get no beams.
///
/// @param wall_sigmas  how well the map knows where each stands [m]
std::vector<GatedWall> gateWalls(const GateConfig& config,
                                 const std::vector<const world::Wall*>& walls,
                                 const std::vector<double>& wall_sigmas,
                                 const geometry::UncertainPose2& T_map_base,
                                 const std::vector<BeamPoint>& points);

/// A beam near a corner lies in the gates of two walls but met one: it stays with the one that it
/// is nearest to.
void giveEachBeamToOneWall(std::vector<GatedWall>& walls);

/// Standard deviation of a point across a line with this normal [m].
double pointSigma(const BeamPoint& point, const Eigen::Vector2d& normal);

/// The points within `sigmas` of their own standard deviations, and `slack` [m], of a line.
std::vector<const BeamPoint*> nearLine(const std::vector<const BeamPoint*>& points,
                                       const geometry::PolarLine& line, double sigmas,
                                       double slack);

/// The points as a line is fitted to them.
std::vector<fitting::NoisyPoint> toFitPoints(const std::vector<const BeamPoint*>& points);

/// Reason why these points on a line do not make a wall; kNone where they do.
WallRefusal refusalOf(const WallConfig& config, const std::vector<const BeamPoint*>& points,
                      const geometry::PolarLine& line);

}  // namespace sightline::tracking
