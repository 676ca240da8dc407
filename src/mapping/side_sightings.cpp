#include "side_sightings.h"

#include <algorithm>
#include <cmath>

namespace sightline::mapping {

namespace {

constexpr struct {
  double facing = 0.94;     // least cosine between the normals of a point and of the side
  double overshoot = 0.02;  // of a point past the end of a side [m]
  std::size_t fewest = 5;   // points of a sighting
  double shortest = 0.15;   // [m]
  // What a sighting of any number of points is wrong by: surfaces are no planes [m].
  double roughness = 0.006;
} kSightings{};

// Sums over points of a key scan on a side.
struct PointSums {
  double weight = 0.0;
  double count = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();

  void add(const Eigen::Vector2d& p, double variance) {
    weight += 1.0 / variance;
    count += 1.0;
    sum += p;
    squares += p * p.transpose();
  }
};

std::optional<SideSighting> conclude(const PointSums& sums) {
  if (sums.count < static_cast<double>(kSightings.fewest)) return std::nullopt;
  const Eigen::Vector2d mean = sums.sum / sums.count;
  const Eigen::Matrix2d scatter = sums.squares / sums.count - mean * mean.transpose();
  const double turn = 0.5 * std::atan2(2.0 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  const Eigen::Vector2d along(std::cos(turn), std::sin(turn));
  const double spread = std::sqrt(std::max(0.0, along.dot(scatter * along)));
  if (spread * std::sqrt(12.0) < kSightings.shortest) return std::nullopt;
  const double sigma = std::sqrt(2.0 / sums.weight + kSightings.roughness * kSightings.roughness);
  return SideSighting{0, 0, 0, {mean - spread * along, mean + spread * along}, sigma};
}

}  // namespace

SightingFinder::SightingFinder(const std::vector<RoomOutline>& rooms, double gate) : gate_(gate) {
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    for (std::size_t i = 0; i < rooms[r].sides.size(); ++i) {
      const geometry::Segment side = rooms[r].side(i);
      targets_.push_back({r, i, side.start, side.leftNormal(), side.direction(), side.length()});
    }
  }
}

void SightingFinder::find(std::size_t number, const KeyScan& key, const geometry::Pose2& pose,
                          std::vector<SideSighting>& sightings) const {
  const Eigen::Matrix2d rotation = pose.rotation();
  std::vector<PointSums> sums(targets_.size());
  for (const auto& point : key.surfaces.points) {
    if (!point.hasNormal()) continue;
    const Eigen::Vector2d place = rotation * point.position + pose.translation();
    if (const auto at = nearest(place, rotation * point.normal)) {
      sums[*at].add(point.position, point.variance);
    }
  }
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (auto sighting = conclude(sums[i])) {
      sighting->key = number;
      sighting->room = targets_[i].room;
      sighting->side = targets_[i].side;
      sightings.push_back(*sighting);
    }
  }
}

std::optional<std::size_t> SightingFinder::nearest(const Eigen::Vector2d& place,
                                                   const Eigen::Vector2d& normal) const {
  std::optional<std::size_t> best;
  double least = gate_;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Target& target = targets_[i];
    const Eigen::Vector2d off = place - target.start;
    const double distance = std::abs(target.normal.dot(off));
    if (distance >= least || target.normal.dot(normal) < kSightings.facing) continue;
    const double along = target.direction.dot(off);
    if (along < -kSightings.overshoot || along > target.length + kSightings.overshoot) continue;
    least = distance;
    best = i;
  }
  return best;
}

}  // namespace sightline::mapping
