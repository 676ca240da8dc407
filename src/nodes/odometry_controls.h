#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include "sightline/bridge/log_throttle.h"
#include "sightline/bridge/odometry_output.h"
#include "sightline/pipeline/estimators.h"

namespace sightline::nodes {

/// The service that starts odometry from scans anew, and how it does, in diagnostics and in the
/// log.
class OdometryControls {
 public:
  /// All of them have to live as long.
  OdometryControls(ros::NodeHandle private_node, pipeline::ScanOdometry& odometry,
                   const bridge::OdometryOutput& output, diagnostic_updater::Updater& updater);

  /// Notes the results for one scan; call it for each.
  void note(const pipeline::Estimates& estimates);

 private:
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  pipeline::ScanOdometry& odometry_;
  const bridge::OdometryOutput& output_;
  dead_reckoning::DeadReckoningUpdate last_;
  bool is_mounting_known_ = false;
  std::size_t flagged_before_ = 0;  // at the last report
  bridge::LogThrottle flagged_;
  ros::ServiceServer reset_server_;
};

}  // namespace sightline::nodes
