#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/keyframe.h"
#include "sightline/dead_reckoning/range_profile.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// The reference of the matching: the surfaces seen from a number of keyframes, found by place.
class Submap {
 public:
  void clear();
  bool empty() const { return keyframes_.empty(); }
  /// Adds a scan at its pose; beyond `most` the oldest are dropped. A scan that was put in at a
  /// wrong pose, as others now tell, is taken out, be it this one. Returns the share of its surfels
  /// that were new.
  double add(const geometry::Pose2& T_odom_base, const SurfaceScan& surfaces, std::size_t most);

  /// The surfel nearest to a point [m, odom] among those that face as `normal` does (any, where
  /// that is zero), within `reach` [m] of it; null where there is none.
  const Surfel* nearest(const Eigen::Vector2d& point, const Eigen::Vector2d& normal,
                        double reach) const;

  /// Oldest first.
  const std::deque<Keyframe>& keyframes() const { return keyframes_; }
  /// The newest that a scanner took; null where there is none.
  const Keyframe* newestOf(std::size_t scanner) const;
  /// Sight of a place [m, odom] by the newest keyframe that knows it, among the newest 50.
  Sight sightOf(const Eigen::Vector2d& point) const;
  const std::vector<Surfel>& surfels() const { return surfels_; }
  /// Number that changes with each change of the submap.
  std::uint64_t version() const { return version_; }

 private:
  struct Nearest {
    Eigen::Vector2d point;
    Eigen::Vector2d normal;
    double facing;  // least cosine between the normals
    double square;  // of the least distance so far [m²]
    const Surfel* surfel;
  };
  void rebuild();
  bool takeOutMisplaced();
  void look(std::size_t cell, Nearest& nearest) const;
  bool insert(const Surfel& surfel);

  std::deque<Keyframe> keyframes_;
  std::vector<Surfel> surfels_;
  std::vector<std::int32_t> next_;   // in the same cell, by surfel; −1 ends
  std::vector<std::int32_t> first_;  // by cell
  std::uint64_t version_ = 0;
};

}  // namespace sightline::dead_reckoning
