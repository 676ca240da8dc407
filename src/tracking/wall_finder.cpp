#include "sightline/tracking/wall_finder.h"

#include <algorithm>
#include <cmath>

#include "sightline/tracking/motion_response.h"

namespace sightline::tracking {

namespace {

using geometry::PolarLine;
using geometry::Pose2;

constexpr struct {
  // Bound of a loop that settles after two or three rounds.
  int most_reassignments = 5;
} kFinder;

double varianceOf(double sigma) {
  return sigma * sigma;
}

// Walls are not as straight as lines: what the residuals show beyond the sensor's noise counts as
// noise.
FittedLine describe(const fitting::LineFit& fit, const std::vector<const BeamPoint*>& points,
                    const Eigen::Matrix3d& walk) {
  const double excess =
      fit.chi_square / static_cast<double>(std::max<std::size_t>(1, fit.degrees_of_freedom));
  FittedLine result;
  result.line = fit.line;
  result.line.covariance *= std::max(1.0, excess);
  const MotionResponse response(points, fit.line, walk);
  result.motion_jacobian = response.jacobian();
  result.line.covariance += response.strayCovariance();
  for (const BeamPoint* point : points) result.accepted_beams.push_back(point->beam);
  return result;
}

}  // namespace

PoseFilter WallFinder::refineByHough(const PoseFilter& predicted, const Walls& walls,
                                     const std::vector<GatedWall>& gated) const {
  const HoughPeaks peaks = hough_.transform(gated);
  PoseFilter refined = predicted;
  for (std::size_t i = 0; i < gated.size(); ++i) {
    const bool is_enough = gated[i].points.size() >= static_cast<std::size_t>(wall_.min_beams);
    if (!peaks.walls[i] || !is_enough) continue;
    const PolarLine coarse = lineAt(*peaks.walls[i], gated[i].gate.predicted());
    refined.update(refined.innovation(coarse, walls[i]->segment.line(), LineBySweepError::Zero()));
  }
  return refined;
}

void WallFinder::addMapUncertainty(const WallConfig& known,
                                   const std::vector<const BeamPoint*>& points, PolarLine& line) {
  // The map's wall is uncertain where it was seen: a turn about that place shifts the foot of the
  // perpendicular.
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  for (const BeamPoint* point : points) centroid += point->position;
  centroid /= static_cast<double>(points.size());
  const double lever = line.direction().dot(centroid);
  const double turn = varianceOf(known.direction_sigma);
  Eigen::Matrix2d added;
  added << varianceOf(known.position_sigma) + lever * lever * turn, lever * turn, lever * turn,
      turn;
  line.covariance += added;
}

void WallFinder::fitWall(const GatedWall& gated, const world::Wall& wall, const Pose2& T_base_map,
                         const Eigen::Matrix3d& walk, WallFit& result) const {
  // Least squares over the beams near the line, which is moved to fit them until they stay the
  // same.
  const WallConfig known = wall_.of(wall);
  PolarLine line = geometry::transform(T_base_map, wall.segment.line());
  std::vector<const BeamPoint*> near = gated.points;
  fitting::LineFit fit;
  for (int i = 0; i < kFinder.most_reassignments; ++i) {
    result.refusal = refusalOf(wall_, near, line);
    if (result.refusal != WallRefusal::kNone) return;
    const auto refined = fitting::refineLine(toFitPoints(near), line);
    result.refusal = refined ? WallRefusal::kNone : WallRefusal::kUndetermined;
    if (!refined) return;
    fit = *refined;
    line = fit.line;
    auto next = nearLine(gated.points, line, gate_.sigmas, known.position_sigma);
    if (next == near) break;
    near = std::move(next);
  }
  result.refusal = refusalOf(wall_, near, line);
  if (result.refusal != WallRefusal::kNone) return;
  result.fit = describe(fit, near, walk);
  addMapUncertainty(known, near, result.fit->line);
}

std::vector<WallFit> WallFinder::find(const PoseFilter& predicted, const world::RoomMap& map,
                                      const std::vector<world::WallIndex>& indices,
                                      const Sweep& sweep) const {
  Walls walls;
  std::vector<double> sigmas;
  for (const world::WallIndex& index : indices) {
    walls.push_back(&map.wall(index));
    sigmas.push_back(wall_.of(*walls.back()).position_sigma);
  }
  const auto gate = [&](const PoseFilter& filter) {
    return gateWalls(gate_, walls, sigmas, filter.assumedPose(), sweep.points);
  };
  const std::vector<GatedWall> first = gate(predicted);
  const PoseFilter refined = refineByHough(predicted, walls, first);
  std::vector<GatedWall> second = gate(refined);
  giveEachBeamToOneWall(second);
  std::vector<WallFit> fits(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    fits[i].room = indices[i].room;
    fits[i].wall = indices[i].wall;
    fits[i].gate = first[i].gate.size();
    fits[i].beams_in_gate = first[i].points.size();
    fitWall(second[i], *walls[i], refined.pose().mean.inverse(), sweep.motion_noise.walk, fits[i]);
  }
  return fits;
}

}  // namespace sightline::tracking
