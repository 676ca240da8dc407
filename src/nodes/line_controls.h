#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include "sightline/LineExtractorConfig.h"
#include "sightline/bridge/live_feed.h"
#include "sightline/pipeline/estimators.h"

namespace sightline::nodes {

/// The thresholds of a running line extractor.
class LineControls {
 public:
  /// The estimators have to live as long.
  LineControls(ros::NodeHandle private_node, const pipeline::LinesConfig& config,
               pipeline::Estimators& estimators);

 private:
  pipeline::LinesConfig config_;
  boost::recursive_mutex reconfigure_mutex_;
  dynamic_reconfigure::Server<LineExtractorConfig> reconfigure_;
};

/// Shows in diagnostics for how many scans the motion within the sweep is known.
class MotionDiagnostics {
 public:
  /// Keeps references to both.
  MotionDiagnostics(const bridge::LiveFeed& feed, diagnostic_updater::Updater& updater);

 private:
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  const bridge::LiveFeed& feed_;
  std::size_t without_before_ = 0;  // at the last report
};

}  // namespace sightline::nodes
