#pragma once

#include <cstddef>
#include <map>
#include <memory>

#include <Eigen/Core>

#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/dead_reckoning/search_rasters.h"
#include "sightline/dead_reckoning/submap.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// A submap of keyframes some way apart, those of each scanner for itself, with the rasters that a
/// search last drew of it.
class Reference {
 public:
  bool empty() const { return submap_.empty(); }
  const Submap& submap() const { return submap_; }
  /// Whether a scan of this scanner is in it.
  bool isSeenBy(std::size_t scanner) const { return newest_.count(scanner) > 0; }

  /// Adds a scan where its scanner has moved far enough. Returns the share of what all scanners
  /// see that is new, [0, 1].
  double add(const SurfaceScan& surfaces, const geometry::Pose2& T_odom_base,
             const SubmapConfig& config);

  /// Rasters that show the submap about a place; drawn anew where the last ones do not.
  const SearchRasters& rastersAbout(const Eigen::Vector2d& centre_odom) const;

 private:
  Submap submap_;
  mutable std::unique_ptr<SearchRasters> rasters_;  // kept for the next search
  std::map<std::size_t, geometry::Pose2> newest_;   // keyframe of each scanner
};

}  // namespace sightline::dead_reckoning
