#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sightline/bridge/feature_output.h"
#include "sightline/bridge/line_output.h"
#include "sightline/bridge/odometry_output.h"
#include "sightline/bridge/room_output.h"
#include "sightline/bridge/shortfall.h"
#include "sightline/logs/trajectory.h"

namespace sightline::bridge {

/// Runs the estimators over a recording and writes their results to a bag, and to one trajectory,
/// `rooms.tum` and `odometry.tum`, for each estimator that has a pose.
class RecordedEstimates {
 public:
  /// Opens DIR/out.bag and the trajectories. Throws config::Error.
  RecordedEstimates(const pipeline::EstimatorsConfig& config, const pipeline::EstimatorSet& set,
                    const std::string& folder);

  /// Runs the estimators on a scan and writes what they find, at this time.
  void take(pipeline::LocatedScan located, const ros::Time& now);
  /// Copies a message as it stands.
  void copy(const rosbag::MessageInstance& message);
  /// Ends the files; call it after the last scan. Throws config::Error if a file could not be
  /// written.
  void close();
  /// Number of scans with a result, of each estimator that was asked for.
  std::vector<EstimatorCount> counts() const;
  /// Summary of the results, a line of text each.
  std::vector<std::string> summary() const;

 private:
  pipeline::EstimatorSet set_;
  std::string folder_;
  pipeline::Estimators estimators_;
  rosbag::Bag bag_;
  ros::Time now_;
  Output output_{bag_, now_};
  std::optional<LineOutput> lines_;
  std::optional<FeatureOutput> features_;
  std::optional<RoomOutput> rooms_;
  std::optional<OdometryOutput> odometry_;
  std::optional<logs::TrajectoryWriter> rooms_trajectory_;
  std::optional<logs::TrajectoryWriter> odometry_trajectory_;
};

}  // namespace sightline::bridge
