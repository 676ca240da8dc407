#include "sightline/tracking/gated_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sightline::tracking {

namespace {

// The median noise of the beams: half the trace holds for beams along the wall's normal as for
// those across it. One beam alone would not do, where the noise is estimated from the scan itself.
double medianSigma(const std::vector<BeamPoint>& points) {
  if (points.empty()) return 0.0;
  std::vector<double> traces;
  traces.reserve(points.size());
  for (const BeamPoint& point : points) traces.push_back(point.covariance.trace());
  const auto middle = traces.begin() + static_cast<std::ptrdiff_t>(traces.size() / 2);
  std::nth_element(traces.begin(), middle, traces.end());
  return std::sqrt(0.5 * *middle);
}

}  // namespace

std::vector<GatedWall> gateWalls(const GateConfig& config,
                                 const std::vector<const world::Wall*>& walls,
                                 const std::vector<double>& wall_sigmas,
                                 const geometry::UncertainPose2& T_map_base,
                                 const std::vector<BeamPoint>& points) {
  std::vector<GatedWall> gated;
  gated.reserve(walls.size());
  const double sigma = medianSigma(points);
  const BeamEnds ends(points);
  std::vector<double> excesses;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    gated.push_back({ValidationGate(config, *walls[i], wall_sigmas[i], T_map_base, sigma), {}});
    if (walls[i]->spans.empty()) continue;
    const ValidationGate& gate = gated.back().gate;
    gate.excesses(ends, excesses);
    for (std::size_t beam = 0; beam < points.size(); ++beam) {
      if (excesses[beam] > 0.0 || !gate.contains(points[beam])) continue;
      gated.back().points.push_back(&points[beam]);
    }
  }
  return gated;
}

void giveEachBeamToOneWall(std::vector<GatedWall>& walls) {
  struct Claim {
    const GatedWall* wall = nullptr;
    double distance = std::numeric_limits<double>::infinity();
  };
  std::size_t beams = 0;
  for (const GatedWall& wall : walls) {
    for (const BeamPoint* point : wall.points) beams = std::max(beams, point->beam + 1);
  }
  std::vector<Claim> claims(beams);
  for (const GatedWall& wall : walls) {
    const geometry::PolarLine& predicted = wall.gate.predicted();
    const Eigen::Vector2d normal = predicted.normal();
    for (const BeamPoint* point : wall.points) {
      const double distance = std::abs(normal.dot(point->position) - predicted.rho);
      Claim& claim = claims[point->beam];
      if (distance < claim.distance) claim = {&wall, distance};
    }
  }
  for (GatedWall& wall : walls) {
    const auto is_of_another = [&](const BeamPoint* point) {
      return claims[point->beam].wall != &wall;
    };
    wall.points.erase(std::remove_if(wall.points.begin(), wall.points.end(), is_of_another),
                      wall.points.end());
  }
}

double pointSigma(const BeamPoint& point, const Eigen::Vector2d& normal) {
  return std::sqrt(normal.dot(point.covariance * normal));
}

std::vector<const BeamPoint*> nearLine(const std::vector<const BeamPoint*>& points,
                                       const geometry::PolarLine& line, double sigmas,
                                       double slack) {
  std::vector<const BeamPoint*> near;
  const Eigen::Vector2d normal = line.normal();
  for (const BeamPoint* point : points) {
    const double reach = sigmas * pointSigma(*point, normal) + slack;
    if (std::abs(normal.dot(point->position) - line.rho) <= reach) near.push_back(point);
  }
  return near;
}

std::vector<fitting::NoisyPoint> toFitPoints(const std::vector<const BeamPoint*>& points) {
  std::vector<fitting::NoisyPoint> result;
  result.reserve(points.size());
  for (const BeamPoint* point : points) result.push_back({point->position, point->covariance});
  return result;
}

WallRefusal refusalOf(const WallConfig& config, const std::vector<const BeamPoint*>& points,
                      const geometry::PolarLine& line) {
  if (points.size() < static_cast<std::size_t>(config.min_beams)) return WallRefusal::kTooFewBeams;
  const Eigen::Vector2d along = line.direction();
  double first = along.dot(points.front()->position);
  double last = first;
  for (const BeamPoint* point : points) {
    first = std::min(first, along.dot(point->position));
    last = std::max(last, along.dot(point->position));
  }
  return last - first >= config.min_length ? WallRefusal::kNone : WallRefusal::kTooShort;
}

}  // namespace sightline::tracking
