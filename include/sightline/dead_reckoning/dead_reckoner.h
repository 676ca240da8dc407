#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/dead_reckoning/match_state.h"
#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"

namespace sightline::dead_reckoning {

/// What something else says of the base's motion since the scan before: wheels, a gyroscope.
struct MotionPrior {
  geometry::Pose2 T_before_now;
  /// Of its coordinates (x, y, θ) [m², m rad, rad²]. Large entries leave to the scans what it does
  /// not know: a gyroscope says nothing of x and y.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

/// What one scan did to the pose.
struct DeadReckoningUpdate {
  std::int64_t stamp = 0;         ///< of the scan, ns
  geometry::UncertainPose2 pose;  ///< T_odom_base at the stamp; grows from zero at the first scan
  geometry::UncertainPose2 step;  ///< T_before_now, from the scan before
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();  ///< in the base, at the stamp [m/s, m/s, rad/s]
  Eigen::Matrix3d twist_covariance = Eigen::Matrix3d::Zero();
  MatchState state = MatchState::kInitial;
  std::size_t beams = 0;  ///< that had a valid return
  double inliers = 0.0;   ///< share of those that found their counterpart in the reference, [0, 1]
  bool searched = false;  ///< whether the local match was unsure and the window was searched

  bool isFlagged() const { return state != MatchState::kMatched && state != MatchState::kInitial; }
};

/// Follows a carrier by its scans alone, or with a prior (saarinen section 4.3.4).
///
/// The frame odom is the base's at the first scan. The prediction is the prior, or constant
/// velocity as uncertain as the carrier's accelerations make it. A sweep whose beams have time
/// offsets and no sensor_motion is corrected by the motion that is found. Whatever comes in,
/// estimates stay finite; not thread-safe.
class DeadReckoner {
 public:
  /// Throws config::Error if the configuration is out of range.
  explicit DeadReckoner(const DeadReckonerConfig& config);
  ~DeadReckoner();
  /// A copy is a try: what it does with a scan can be kept or thrown away.
  DeadReckoner(const DeadReckoner&);
  DeadReckoner(DeadReckoner&&) noexcept;
  DeadReckoner& operator=(DeadReckoner&&) noexcept;

  /// Takes one scan. Nothing for one that is not newer than the one before. The mounting has to be
  /// level: of a sensor upside down the angles are mirrored first, which makes them fall. Throws
  /// scan::InvalidScan where the scan's vectors do not have one entry a beam.
  std::optional<DeadReckoningUpdate> update(const scan::Scan& scan,
                                            const geometry::Pose2& T_base_sensor,
                                            const std::optional<MotionPrior>& prior = {});

  /// Forgets reference and motion. The next scan is at `T_odom_base`, of which it is certain.
  void reset(const geometry::Pose2& T_odom_base = {});
  /// Forgets the stamp of the last scan but keeps the pose: the clock was set back.
  void restartClock();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sightline::dead_reckoning
