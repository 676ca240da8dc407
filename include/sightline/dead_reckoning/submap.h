#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// A small straight piece of a surface, in the frame odom.
struct Surfel {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m]
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();    ///< unit, to the side it was seen from
  double reach = 0.0;                                  ///< half length [m]
};

/// The reference of the matching: the surfaces seen from a number of keyframes, found by place.
class Submap {
 public:
  /// A counterpart is sought this far [m].
  static constexpr double kReach = 0.25;

  void clear();
  bool empty() const { return keyframes_.empty(); }
  /// Adds a scan at its pose; beyond `most` the oldest is dropped.
  void add(const geometry::Pose2& T_odom_base, const std::vector<SurfacePoint>& points,
           std::size_t most);

  /// The surfel nearest to a point [m, odom] among those that face as `normal` does (any, where
  /// that is zero), within kReach; null where there is none.
  const Surfel* nearest(const Eigen::Vector2d& point, const Eigen::Vector2d& normal) const;

  const std::vector<Surfel>& surfels() const { return sorted_; }

 private:
  void rebuild();

  std::deque<std::vector<Surfel>> keyframes_;
  std::vector<Surfel> sorted_;        // by cell
  std::vector<std::uint32_t> begin_;  // of each cell's surfels in sorted_
};

}  // namespace sightline::dead_reckoning
