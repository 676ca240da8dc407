#include "sightline/mapping/side_evidence.h"

#include <algorithm>
#include <cmath>

namespace sightline::mapping {

namespace {

using geometry::Pose2;

constexpr struct {
  double near = 0.05;     // a point this near is on the side [m]
  double before = 0.3;    // a surface so far before it that faces as it does hides it [m]
  double beyond = 0.15;   // a ray that ends this far beyond has passed through [m]
  double facing = 0.8;    // least cosine between the normals of point and side
  double bridged = 0.2;   // gap that nobody saw, between walls [m]
  double shortest = 0.2;  // span [m]
} kEvidence{};

// A side as rays meet it.
struct Target {
  Eigen::Vector2d start;
  Eigen::Vector2d normal;
  Eigen::Vector2d direction;
  double length;
  SideEvidence* evidence;

  void take(const Eigen::Vector2d& eye, const Eigen::Vector2d& end,
            const Eigen::Vector2d& facing) const {
    const double before = normal.dot(eye - start);
    if (before <= 0.0) return;
    const double after = normal.dot(end - start);
    if (after > kEvidence.before) return;
    if (after >= -kEvidence.near) {
      const double along = direction.dot(end - start);
      if (along < 0.0 || along > length || facing.dot(normal) < kEvidence.facing) return;
      auto& met = after <= kEvidence.near ? evidence->hits : evidence->hidden;
      ++met[evidence->binAt(along)];
    } else if (after < -kEvidence.beyond) {
      const Eigen::Vector2d crossing = eye + before / (before - after) * (end - eye);
      const double along = direction.dot(crossing - start);
      if (along < 0.0 || along > length) return;
      ++evidence->passes[evidence->binAt(along)];
    }
  }
};

std::vector<Target> targetsOf(const std::vector<RoomOutline>& rooms,
                              std::vector<std::vector<SideEvidence>>& evidence) {
  std::vector<Target> targets;
  evidence.resize(rooms.size());
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    evidence[r].resize(rooms[r].sides.size());
    for (std::size_t i = 0; i < rooms[r].sides.size(); ++i) {
      const geometry::Segment side = rooms[r].side(i);
      SideEvidence& here = evidence[r][i];
      const auto bins = static_cast<std::size_t>(std::ceil(side.length() / SideEvidence::kBin));
      here.hits.assign(std::max<std::size_t>(1, bins), 0);
      here.passes = here.hidden = here.hits;
      targets.push_back({side.start, side.leftNormal(), side.direction(), side.length(), &here});
    }
  }
  return targets;
}

}  // namespace

std::size_t SideEvidence::binAt(double along) const {
  const double bin = std::floor(along / kBin);
  return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(bins() - 1)));
}

std::vector<std::vector<SideEvidence>> gatherEvidence(const std::vector<KeyScan>& keys,
                                                      const std::vector<Pose2>& poses,
                                                      const std::vector<RoomOutline>& rooms) {
  std::vector<std::vector<SideEvidence>> evidence;
  const std::vector<Target> targets = targetsOf(rooms, evidence);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const Eigen::Matrix2d rotation = poses[k].rotation();
    const Eigen::Vector2d eye = poses[k] * keys[k].surfaces.sensor;
    for (const auto& point : keys[k].surfaces.points) {
      const Eigen::Vector2d end = rotation * point.position + poses[k].translation();
      const Eigen::Vector2d facing = rotation * point.normal;
      for (const Target& target : targets) target.take(eye, end, facing);
    }
    for (const Eigen::Vector2d& miss : keys[k].misses) {
      const Eigen::Vector2d end = poses[k] * miss;
      for (const Target& target : targets) target.take(eye, end, Eigen::Vector2d::Zero());
    }
  }
  return evidence;
}

std::vector<world::Span> spansOf(const SideEvidence& evidence, double length) {
  std::vector<world::Span> spans;
  std::size_t unseen = 0;  // bins since the last wall, none of them open
  bool was_open = true;
  for (std::size_t i = 0; i < evidence.bins(); ++i) {
    if (evidence.isOpen(i)) was_open = true;
    if (!evidence.isWall(i)) {
      ++unseen;
      continue;
    }
    const double from = static_cast<double>(i) * SideEvidence::kBin;
    const double to = std::min(length, from + SideEvidence::kBin);
    const bool goes_on = !spans.empty() && !was_open &&
                         static_cast<double>(unseen) * SideEvidence::kBin <= kEvidence.bridged;
    if (goes_on) {
      spans.back().to = to;
    } else {
      spans.push_back({from, to});
    }
    unseen = 0;
    was_open = false;
  }
  spans.erase(std::remove_if(
                  spans.begin(), spans.end(),
                  [](const world::Span& span) { return span.to - span.from < kEvidence.shortest; }),
              spans.end());
  return spans;
}

}  // namespace sightline::mapping
