#pragma once

#include <optional>
#include <vector>

#include "sightline/logs/trajectory.h"

namespace sightline::logs {

/// Motion between two scans by the scans alone.
struct ScanStep {
  std::int64_t before = 0;  ///< stamp [ns]
  std::int64_t now = 0;     ///< stamp [ns]
  geometry::Pose2 motion;   ///< T_before_now of the base
};

/// An odometry held against steps that scans have measured.
struct StepComparison {
  /// Time by which the scans' stamps are behind the odometry's [s]: positive where a scan is older
  /// or its stamp later than it says. Nothing where the turns do not tell.
  std::optional<double> offset;
  double offset_sigma = 0.0;  ///< [s]
  /// Distance by scans over distance by odometry, on straight stretches; nothing where too little
  /// was driven.
  std::optional<double> scale;
};

/// Compares by correlating turns: the offset is where the turns of the odometry come nearest to
/// those of the scans (least squares over offsets of up to half a second).
StepComparison compareSteps(const std::vector<ScanStep>& steps, const Trajectory& odometry);

}  // namespace sightline::logs
