#include "sightline/triangulation/flat_target.h"

#include <algorithm>
#include <cmath>

namespace sightline::triangulation {

namespace {

// Point where the parallel ray that runs `offset` to the left of the axis meets the target.
Eigen::Vector2d meet(double depth, double angle, double offset) {
  return {depth, (depth * std::sin(angle) + offset) / std::cos(angle)};
}

// Light that the lens gathers from there, up to a factor.
double gathered(const Eigen::Vector2d& spot, const Eigen::Vector2d& lens) {
  const Eigen::Vector2d displacement = spot - lens;
  const double squared = displacement.squaredNorm();
  return displacement.x() / (squared * std::sqrt(squared));
}

}  // namespace

double powerBeyond(double reach, double width) {
  if (std::abs(reach) >= 0.5 * width) return reach > 0.0 ? 1.0 : 0.0;
  const double from_axis = reach / (0.25 * width);  // in standard deviations, of which 2 are within
  return 0.5 + 0.5 * std::erf(from_axis * std::sqrt(0.5)) / std::erf(std::sqrt(2.0));
}

SpotOnTarget spotOnTarget(const ProjectionGeometry& geometry, double depth, double angle,
                          double beam_width) {
  const auto lens = geometry.lens(angle);
  const double axis = geometry.imagePosition(meet(depth, angle, 0.0), lens);
  // Three rays with the variance of a Gaussian that ends at two standard deviations.
  const double node = std::sqrt(3.0 * 0.7737) * 0.25 * beam_width;
  double light = 0.0;
  double moment = 0.0;
  for (const auto& [offset, share] : {std::pair{-node, 1.0}, {0.0, 4.0}, {node, 1.0}}) {
    const Eigen::Vector2d spot = meet(depth, angle, offset);
    const double current = share * gathered(spot, lens.centre);
    light += current;
    moment += current * (geometry.imagePosition(spot, lens) - axis);
  }
  const auto reach = [&](double offset) {
    return std::abs(geometry.imagePosition(meet(depth, angle, offset), lens) - axis);
  };
  return {moment / light, std::max(reach(0.5 * beam_width), reach(-0.5 * beam_width))};
}

}  // namespace sightline::triangulation
