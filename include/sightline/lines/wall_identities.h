#pragma once

#include <cstdint>
#include <vector>

#include "sightline/geometry/line_segment.h"
#include "sightline/lines/carrier_step.h"
#include "sightline/lines/feature_tracker_config.h"

namespace sightline::lines {

/// Gives segments ids that last as long as their walls stay in view. Walls are known again by their
/// lines and by where on the line they were seen.
class WallIdentities {
 public:
  explicit WallIdentities(const FeatureTrackerConfig& config) : config_(config) {}

  void predict(const CarrierStep& step, double elapsed);
  /// Fills in the ids of the segments of a scan; no two get the same.
  void identify(std::vector<geometry::LineSegment>& segments, const geometry::Pose2& T_base_sensor);
  /// Forgets all walls. Their ids are not given again.
  void clear() { walls_.clear(); }
  std::size_t size() const { return walls_.size(); }

 private:
  // In the frame of the base at the last scan.
  struct Wall {
    std::uint32_t id;
    geometry::PolarLine line;
    geometry::Segment ends;  // of all that was seen of it
    double unseen = 0.0;     // [s]
  };
  struct Match {
    std::size_t wall;
    std::size_t segment;
    double overlap;  // [m]
  };
  std::vector<Match> matches(const std::vector<Wall>& seen) const;
  static void renew(Wall& wall, const Wall& seen);
  void forget();

  FeatureTrackerConfig config_;
  std::vector<Wall> walls_;
  std::uint32_t last_id_ = 0;
};

}  // namespace sightline::lines
