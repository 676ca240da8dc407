#include "sightline/tracking/wall_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <Eigen/LU>

#include "sightline/fitting/line_fit.h"

namespace sightline::tracking {

namespace {

using geometry::PolarLine;
using geometry::Pose2;

constexpr int kMaxReassignments = 5;

double varianceOf(double sigma) {
  return sigma * sigma;
}

// The noise of a typical beam: half the trace holds for beams along the wall's normal as for those
// across it.
double typicalSigma(const std::vector<BeamPoint>& points) {
  if (points.empty()) return 0.0;
  return std::sqrt(0.5 * points[points.size() / 2].covariance.trace());
}

double pointSigma(const BeamPoint& point, const Eigen::Vector2d& normal) {
  return std::sqrt(normal.dot(point.covariance * normal));
}

// How a fit follows the points that the motion of the sensor carries along, each by its share of
// the sweep: the normal equations of the fit, with the points' displacement along the normal on
// their right-hand side.
Eigen::Matrix<double, 2, 3> motionJacobian(const std::vector<const BeamPoint*>& points,
                                           const PolarLine& line) {
  const Eigen::Vector2d normal = line.normal();
  const Eigen::Vector2d along = line.direction();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 2, 3> moved = Eigen::Matrix<double, 2, 3>::Zero();
  for (const BeamPoint* point : points) {
    const double weight = 1.0 / varianceOf(pointSigma(*point, normal));
    const double position = along.dot(point->position);
    const Eigen::Vector2d residual_by_line(-1.0, position);
    const Eigen::RowVector3d residual_by_motion(normal.x(), normal.y(), -position);
    information += weight * residual_by_line * residual_by_line.transpose();
    moved += weight * point->sweep_share * residual_by_line * residual_by_motion;
  }
  return -information.inverse() * moved;
}

// A beam near a corner lies in the gates of two walls but met one: the one it is nearest to.
void giveEachBeamToOneWall(std::vector<GatedWall>& walls) {
  struct Claim {
    const GatedWall* wall = nullptr;
    double distance = std::numeric_limits<double>::infinity();
  };
  std::unordered_map<const BeamPoint*, Claim> claims;
  for (const GatedWall& wall : walls) {
    for (const BeamPoint* point : wall.points) {
      const double distance = std::abs(wall.gate.predicted().signedDistance(point->position));
      Claim& claim = claims[point];
      if (distance < claim.distance) claim = {&wall, distance};
    }
  }
  for (GatedWall& wall : walls) {
    const auto is_of_another = [&](const BeamPoint* point) { return claims[point].wall != &wall; };
    wall.points.erase(std::remove_if(wall.points.begin(), wall.points.end(), is_of_another),
                      wall.points.end());
  }
}

std::vector<fitting::NoisyPoint> toFitPoints(const std::vector<const BeamPoint*>& points) {
  std::vector<fitting::NoisyPoint> result;
  result.reserve(points.size());
  for (const BeamPoint* point : points) result.push_back({point->position, point->covariance});
  return result;
}

}  // namespace

std::vector<GatedWall> WallFinder::gate(const PoseFilter& filter, const Walls& walls,
                                        const std::vector<BeamPoint>& points) const {
  std::vector<GatedWall> gated;
  gated.reserve(walls.size());
  const double sigma = typicalSigma(points);
  for (const world::Wall* wall : walls) {
    gated.push_back(
        {ValidationGate(config_.gate, *wall, config_.wall.position_sigma, filter.pose(), sigma),
         {}});
    if (wall->spans.empty()) continue;
    for (const BeamPoint& point : points) {
      if (gated.back().gate.contains(point)) gated.back().points.push_back(&point);
    }
  }
  return gated;
}

PoseFilter WallFinder::refineByHough(const PoseFilter& predicted, const Walls& walls,
                                     const std::vector<GatedWall>& gated) const {
  const HoughPeaks peaks = hough_.transform(gated);
  PoseFilter refined = predicted;
  for (std::size_t i = 0; i < gated.size(); ++i) {
    if (!peaks.walls[i] ||
        gated[i].points.size() < static_cast<std::size_t>(config_.wall.min_beams)) {
      continue;
    }
    PolarLine coarse = gated[i].gate.predicted();
    coarse.rho += peaks.walls[i]->distance;
    coarse.phi += peaks.turn;
    coarse.covariance << varianceOf(config_.hough.distance_bin), 0.0, 0.0,
        varianceOf(config_.hough.angle_bin);
    refined.update(refined.innovation(geometry::canonical(coarse), walls[i]->segment.line(),
                                      Eigen::Matrix<double, 2, 3>::Zero()));
  }
  return refined;
}

std::vector<const BeamPoint*> WallFinder::nearLine(const std::vector<const BeamPoint*>& points,
                                                   const PolarLine& line, double slack) const {
  std::vector<const BeamPoint*> near;
  const Eigen::Vector2d normal = line.normal();
  for (const BeamPoint* point : points) {
    const double reach = config_.gate.sigmas * pointSigma(*point, normal) + slack;
    if (std::abs(line.signedDistance(point->position)) <= reach) near.push_back(point);
  }
  return near;
}

bool WallFinder::isEnough(const std::vector<const BeamPoint*>& points,
                          const PolarLine& line) const {
  if (points.size() < static_cast<std::size_t>(config_.wall.min_beams)) return false;
  const Eigen::Vector2d along = line.direction();
  double first = along.dot(points.front()->position);
  double last = first;
  for (const BeamPoint* point : points) {
    first = std::min(first, along.dot(point->position));
    last = std::max(last, along.dot(point->position));
  }
  return last - first >= config_.wall.min_length;
}

void WallFinder::addMapUncertainty(const std::vector<const BeamPoint*>& points,
                                   PolarLine& line) const {
  // The map's wall is uncertain where it was seen: a turn about that place shifts the foot of the
  // perpendicular.
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  for (const BeamPoint* point : points) centroid += point->position;
  centroid /= static_cast<double>(points.size());
  const double lever = line.direction().dot(centroid);
  const double turn = varianceOf(config_.wall.direction_sigma);
  Eigen::Matrix2d added;
  added << varianceOf(config_.wall.position_sigma) + lever * lever * turn, lever * turn,
      lever * turn, turn;
  line.covariance += added;
}

void WallFinder::fitWall(const GatedWall& gated, const world::Wall& wall, const Pose2& T_base_map,
                         WallObservation& observation) const {
  // Least squares over the beams near the line, which is moved to fit them until they stay the
  // same.
  PolarLine line = geometry::transform(T_base_map, wall.segment.line());
  std::vector<const BeamPoint*> near = gated.points;
  fitting::LineFit fit;
  for (int i = 0; i < kMaxReassignments; ++i) {
    if (!isEnough(near, line)) return;
    const auto refined = fitting::refineLine(toFitPoints(near), line);
    if (!refined) return;
    fit = *refined;
    line = fit.line;
    auto next = nearLine(gated.points, line, config_.wall.position_sigma);
    if (next == near) break;
    near = std::move(next);
  }
  if (!isEnough(near, line)) return;
  // Walls are not as straight as lines: what the residuals show beyond the sensor's noise counts as
  // noise.
  const double excess =
      fit.chi_square / static_cast<double>(std::max<std::size_t>(1, fit.degrees_of_freedom));
  observation.fit = line;
  observation.fit.covariance *= std::max(1.0, excess);
  addMapUncertainty(near, observation.fit);
  observation.motion_jacobian = motionJacobian(near, line);
  for (const BeamPoint* point : near) observation.accepted_beams.push_back(point->beam);
  observation.accepted = true;
}

std::vector<WallObservation> WallFinder::find(const PoseFilter& predicted,
                                              const world::RoomMap& map,
                                              const std::vector<WallIndex>& indices,
                                              const Sweep& sweep) const {
  Walls walls;
  for (const WallIndex& index : indices) {
    walls.push_back(&map.rooms()[index.room].walls[index.wall]);
  }
  const std::vector<GatedWall> first = gate(predicted, walls, sweep.points);
  const PoseFilter refined = refineByHough(predicted, walls, first);
  std::vector<GatedWall> second = gate(refined, walls, sweep.points);
  giveEachBeamToOneWall(second);
  std::vector<WallObservation> observations(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    observations[i].room = indices[i].room;
    observations[i].wall = indices[i].wall;
    observations[i].gate = first[i].gate.size();
    observations[i].beams_in_gate = first[i].points.size();
    fitWall(second[i], *walls[i], refined.pose().mean.inverse(), observations[i]);
  }
  return observations;
}

}  // namespace sightline::tracking
