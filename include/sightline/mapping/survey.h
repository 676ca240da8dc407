#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/geometry/pose2.h"
#include "sightline/pipeline/estimators.h"

namespace sightline::mapping {

/// Share of some work that is done, 0 to 1.
using Progress = std::function<void(double)>;

/// Place of one scan of a recording.
struct PathPoint {
  std::int64_t stamp = 0;       ///< [ns]
  geometry::Pose2 T_odom_base;  ///< by dead reckoning
  std::size_t key = 0;          ///< the last key scan up to here
  /// By the wheels, where they are known.
  std::optional<geometry::Pose2> T_wheels_base;
  bool wheels_broke = false;  ///< since the scan before
};

/// A scan that is kept, as it says something new.
struct KeyScan {
  geometry::Pose2 T_odom_base;  ///< by dead reckoning
  /// Motion from the key scan before, by dead reckoning, and by the wheels where they are known.
  geometry::UncertainPose2 step;
  std::optional<geometry::Pose2> wheel_step;
  double way = 0.0;  ///< length of the path up to here [m]
  dead_reckoning::SurfaceScan surfaces;
  std::vector<Eigen::Vector2d> misses;  ///< ends of beams that met nothing, in the base [m]
};

/// Reads a recording scan by scan: dead reckoning with wheels as its prior, and from it the path
/// and the key scans, 0.3 m or 15° apart. Only the first scanner is used.
class Survey {
 public:
  /// Throws config::Error if the configuration is out of range.
  explicit Survey(const pipeline::EstimatorsConfig& config);

  void take(pipeline::LocatedScan located);

  const std::vector<PathPoint>& path() const { return path_; }
  const std::vector<KeyScan>& keys() const { return keys_; }
  /// Number of scans without a place: dead reckoning bridged them.
  std::size_t bridged() const { return bridged_; }
  /// Number of key scans whose motion the wheels tell.
  std::size_t withWheels() const;

 private:
  bool isNew(const geometry::Pose2& T_odom_base) const;
  void advance(const dead_reckoning::DeadReckoningUpdate& update);
  void addKey(const pipeline::LocatedScan& located, const geometry::Pose2& T_odom_base);
  std::optional<geometry::Pose2> wheelStep(const pipeline::LocatedScan& located);

  std::unique_ptr<pipeline::Estimators> estimators_;  // apart, so that a survey can be moved
  std::vector<PathPoint> path_;
  std::vector<KeyScan> keys_;
  geometry::UncertainPose2 step_;                // since the last key scan
  std::optional<geometry::Pose2> T_wheels_key_;  // of the last key scan, by the wheels
  bool wheels_broke_ = false;                    // since the last key scan
  double way_ = 0.0;
  std::size_t bridged_ = 0;
};

}  // namespace sightline::mapping
