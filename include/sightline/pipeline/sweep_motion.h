#pragma once

#include <cstdint>

#include "sightline/pipeline/arrived_scan.h"
#include "sightline/pipeline/feed_config.h"
#include "sightline/pipeline/located_scan.h"
#include "sightline/pipeline/odometry_bridge.h"

namespace sightline::pipeline {

/// Fills in how a sensor moved during a sweep, by odometry and the joint of its head, and how well
/// that is known.
class SweepMotion {
 public:
  using PoseAt = OdometryBridge::PoseAt;

  explicit SweepMotion(const FeedConfig& config) : config_(config) {}

  /// Nothing is filled in where the odometry is not known, or broke, during the sweep.
  ///
  /// @param T_odom_carried  path of what moves with the sensor's mount
  /// @param T_odom_base     path of the base
  /// @param lag             time by which both are late: the motion of so long ago stands for that
  ///                        of the sweep [ns]
  void add(const ArrivedScan& arrived, const PoseAt& T_odom_carried, const PoseAt& T_odom_base,
           std::int64_t lag, LocatedScan& located) const;

 private:
  void addNoise(const ArrivedScan& arrived, const PoseAt& T_odom_base, std::int64_t lag,
                LocatedScan& located) const;
  void addJitter(const ArrivedScan& arrived, LocatedScan& located) const;

  FeedConfig config_;
};

}  // namespace sightline::pipeline
