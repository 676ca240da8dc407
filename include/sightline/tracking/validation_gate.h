#pragma once

#include <vector>

#include "sightline/geometry/polar_line.h"
#include "sightline/geometry/pose2.h"
#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/tracker_config.h"
#include "sightline/tracking/wall_fit.h"
#include "sightline/world/room_map.h"

namespace sightline::tracking {

/// Region in which one wall of the map is looked for in a scan, given an uncertain pose (jensfelt
/// section 4.2.1 and fig. 4).
class ValidationGate {
 public:
  /// `point_sigma` is the sensor's noise [m], the part of δ that is not the pose's.
  ValidationGate(const GateConfig& config, const world::Wall& wall, double wall_sigma,
                 const geometry::UncertainPose2& T_map_base, double point_sigma);

  /// Whether a beam may have met the wall: within δ + distance from the foot · tan γ of the
  /// predicted line, on a stretch where the wall is really there, met from inside the room.
  bool contains(const BeamPoint& point) const;
  /// How far each end of a beam lies outside, whatever stretch of the wall it is on; negative
  /// inside [m].
  void excesses(const BeamEnds& ends, std::vector<double>& excesses) const;

  const GateSize& size() const { return size_; }
  /// The wall as predicted, in the base frame.
  const geometry::PolarLine& predicted() const { return predicted_; }

 private:
  bool isOnSpan(double along) const;

  const world::Wall* wall_;
  GateSize size_;
  geometry::PolarLine predicted_;
  Eigen::Vector2d normal_;     // into the room
  Eigen::Vector2d direction_;  // from the wall's start to its end
  Eigen::Vector2d start_base_;
  double slope_ = 0.0;        // tan γ
  double foot_ = 0.0;         // of the perpendicular from the base, metres from the wall's start
  double along_slack_ = 0.0;  // how far the spans may be shifted along the wall [m]
};

}  // namespace sightline::tracking
