#include "sightline/fitting/rigid_alignment.h"

#include <cmath>

namespace sightline::fitting {

std::optional<geometry::Pose2> alignPoints(const std::vector<PointPair>& pairs) {
  if (pairs.size() < 2) return std::nullopt;
  PointPair centre{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  for (const PointPair& pair : pairs) {
    centre.target += pair.target / static_cast<double>(pairs.size());
    centre.source += pair.source / static_cast<double>(pairs.size());
  }
  double cosines = 0.0;
  double sines = 0.0;
  for (const PointPair& pair : pairs) {
    const Eigen::Vector2d target = pair.target - centre.target;
    const Eigen::Vector2d source = pair.source - centre.source;
    cosines += source.dot(target);
    sines += source.x() * target.y() - source.y() * target.x();
  }
  if (std::hypot(cosines, sines) < 1e-12) return std::nullopt;
  const geometry::Pose2 turn(0.0, 0.0, std::atan2(sines, cosines));
  return geometry::Pose2(centre.target - turn * centre.source, turn.theta());
}

}  // namespace sightline::fitting
