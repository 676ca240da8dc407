#include "sightline/lines/wall_identities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sightline::lines {

namespace {

using geometry::PolarLine;
using geometry::Segment;

// Chosen: how far the line of a wall that is not quite straight may move from scan to scan, beyond
// its covariance, and how far apart two pieces of a wall may be.
constexpr struct {
  double sigmas = 4.0;
  double offset = 0.05;  // [m]
  double angle = 0.06;   // [rad]
  double gap = 0.3;      // [m]
} kIdentity;

double squaredWidth(const PolarLine& line, const Eigen::Vector2d& point) {
  const Eigen::Vector2d response(1.0, -line.direction().dot(point));
  return response.dot(line.covariance * response);
}

// Whether a segment may be of a wall, by their lines.
bool areAlike(const PolarLine& wall, const PolarLine& line, const Segment& ends) {
  const PolarLine described = geometry::describedLike(wall, line);
  const double angle = std::abs(geometry::wrapAngle(described.phi - wall.phi));
  const double angle_sigma = std::sqrt(wall.covariance(1, 1) + line.covariance(1, 1));
  if (angle > kIdentity.angle + kIdentity.sigmas * angle_sigma) return false;
  const Eigen::Vector2d middle = ends.midpoint();
  const double sigma = std::sqrt(squaredWidth(wall, middle) + squaredWidth(line, middle));
  return std::abs(wall.signedDistance(middle)) < kIdentity.offset + kIdentity.sigmas * sigma;
}

// Length that two pieces of a line share; negative where they are apart.
double overlapOf(const Segment& wall, const Segment& piece) {
  const double a = wall.along(piece.start);
  const double b = wall.along(piece.end);
  return std::min(wall.length(), std::max(a, b)) - std::max(0.0, std::min(a, b));
}

}  // namespace

void WallIdentities::predict(const CarrierStep& step, double elapsed) {
  const geometry::UncertainPose2 T_now_before =
      geometry::inverse({step.T_before_now, step.covariance});
  for (Wall& wall : walls_) {
    wall.line = geometry::transform(T_now_before, wall.line);
    wall.ends = T_now_before.mean * wall.ends;
    wall.unseen += elapsed;
  }
}

std::vector<WallIdentities::Match> WallIdentities::matches(const std::vector<Wall>& seen) const {
  std::vector<Match> result;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    for (std::size_t s = 0; s < seen.size(); ++s) {
      const double overlap = overlapOf(walls_[w].ends, seen[s].ends);
      if (overlap < -kIdentity.gap) continue;
      if (areAlike(walls_[w].line, seen[s].line, seen[s].ends)) result.push_back({w, s, overlap});
    }
  }
  std::sort(result.begin(), result.end(),
            [](const Match& a, const Match& b) { return a.overlap > b.overlap; });
  return result;
}

// The line as it is seen now, and on it all that was ever seen of the wall.
void WallIdentities::renew(Wall& wall, const Wall& seen) {
  const Segment before = wall.ends;
  wall.line = seen.line;
  wall.ends = seen.ends;
  const double from = std::min({0.0, seen.ends.along(before.start), seen.ends.along(before.end)});
  const double to =
      std::max({seen.ends.length(), seen.ends.along(before.start), seen.ends.along(before.end)});
  const Eigen::Vector2d direction = seen.ends.direction();
  wall.ends = {seen.ends.start + from * direction, seen.ends.start + to * direction};
  wall.unseen = 0.0;
}

void WallIdentities::identify(std::vector<geometry::LineSegment>& segments,
                              const geometry::Pose2& T_base_sensor) {
  std::vector<Wall> seen;
  for (const geometry::LineSegment& segment : segments) {
    seen.push_back(
        {0, geometry::transform(T_base_sensor, segment.line), T_base_sensor * segment.ends});
  }
  std::vector<bool> taken(walls_.size(), false);
  for (const Match& match : matches(seen)) {
    if (taken[match.wall] || seen[match.segment].id != 0) continue;
    taken[match.wall] = true;
    seen[match.segment].id = walls_[match.wall].id;
    renew(walls_[match.wall], seen[match.segment]);
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].id == 0) {
      seen[i].id = ++last_id_;
      walls_.push_back(seen[i]);
    }
    segments[i].id = seen[i].id;
  }
  forget();
}

void WallIdentities::forget() {
  walls_.erase(std::remove_if(walls_.begin(), walls_.end(),
                              [&](const Wall& wall) { return wall.unseen > config_.wall_memory; }),
               walls_.end());
  const auto most = static_cast<std::size_t>(config_.max_walls);
  if (walls_.size() <= most) return;
  std::stable_sort(walls_.begin(), walls_.end(),
                   [](const Wall& a, const Wall& b) { return a.unseen < b.unseen; });
  walls_.resize(most);
}

}  // namespace sightline::lines
