#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"

namespace sightline::dead_reckoning {

/// The last scan of a scanner, and how the base moved then.
struct ScannerTrack {
  std::int64_t stamp = 0;  ///< [ns]
  double time = 0.0;       ///< of the reckoner [s]
  geometry::Pose2 T_odom_base;
  bool is_moving = false;                                  ///< whether the twist is known
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();         ///< [m/s, m/s, rad/s], in the base
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< [m/s², m/s², rad/s²]
  bool is_held = false;  ///< whether the scan was matched, or the reference began with it

  geometry::Pose2 stepTo(const geometry::Pose2& now_odom) const {
    return geometry::between(T_odom_base, now_odom);
  }
  /// Acceleration to the twist that is found so long [s] after, zero where no twist was known;
  /// averaged over some time, as what is found of a sweep comes back in what is found of the next.
  Eigen::Vector3d accelerationTo(const Eigen::Vector3d& found, double elapsed) const;
};

/// The last scans of all scanners, by their numbers.
class ScannerTracks {
 public:
  void clear() { tracks_.clear(); }
  void set(std::size_t scanner, const ScannerTrack& track) { tracks_[scanner] = track; }
  /// Null where the scanner has given none.
  const ScannerTrack* of(std::size_t scanner) const;
  /// Whether another scanner's last scan held the pose, at this time of the reckoner [s] or later.
  bool isHeldByOther(std::size_t scanner, double since) const;

 private:
  std::map<std::size_t, ScannerTrack> tracks_;
};

}  // namespace sightline::dead_reckoning
