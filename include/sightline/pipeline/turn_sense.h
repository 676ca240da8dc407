#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/pipeline/profile_turn.h"
#include "sightline/scan/scan.h"

namespace sightline::pipeline {

/// Tells whether one scanner's beams run in the sense that its angles say. A driver that mirrors
/// its scans shows a world that turns with the robot: each turn that the odometry tells is held
/// against the scans at its two ends, once as they are and once mirrored. Odometry that counts
/// turns the wrong way looks just the same.
class TurnSense {
 public:
  /// Takes a scan of evenly spaced beams and where the base then was by its odometry.
  void add(const scan::Scan& scan, const geometry::Pose2& T_odom_base,
           const geometry::Pose2& T_base_sensor);
  /// Whether turns of the scans are opposite to those of the odometry.
  bool isOpposite() const;
  /// Forgets the last scan: the odometry broke, or the clock was set.
  void skip() { anchor_.reset(); }

 private:
  enum Sense : std::size_t { kSame, kOpposite };
  struct Anchor {
    geometry::Pose2 T_odom_base;
    std::vector<OrderedReturn> returns;
  };
  void vote(const scan::Scan& scan, const geometry::Pose2& T_before_now);

  std::optional<Anchor> anchor_;
  std::array<double, 2> votes_{};
};

}  // namespace sightline::pipeline
