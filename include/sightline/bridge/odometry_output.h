#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nav_msgs/Odometry.h>

#include "sightline/bridge/output.h"
#include "sightline/bridge/shortfall.h"
#include "sightline/pipeline/estimators.h"

namespace sightline::bridge {

/// Odometry from scans on `laser_odom`, and odom→base on tf where asked for.
class OdometryOutput {
 public:
  OdometryOutput(Output& output, const pipeline::Frames& frames, bool publish_tf);

  /// Returns why there is none for this scan; empty where there is one.
  std::string write(const pipeline::Estimates& estimates);

  /// Number of scans that were matched with this outcome.
  std::size_t count(dead_reckoning::MatchState state) const {
    return states_[static_cast<std::size_t>(state)];
  }
  EstimatorCount counted() const { return {"odometry", scans_ - left_out_, without_pose_}; }
  std::vector<std::string> summary() const;

 private:
  pipeline::Frames frames_;
  bool publish_tf_;
  std::optional<std::int64_t> sent_;  // stamp of the last transform [ns]
  Port<nav_msgs::Odometry> odometry_;
  Port<tf2_msgs::TFMessage> transforms_;
  std::array<std::size_t, 6> states_{};  // how many scans each state had
  std::size_t scans_ = 0;
  std::size_t left_out_ = 0;
  ScansByReason without_pose_;
  std::size_t with_wheels_ = 0;
};

}  // namespace sightline::bridge
