#include "nodes/odometry_controls.h"

#include <algorithm>

#include <ros/console.h>

#include "sightline/bridge/laser_odometry_messages.h"
#include "sightline/bridge/time.h"

namespace sightline::nodes {

using dead_reckoning::MatchState;

OdometryControls::OdometryControls(ros::NodeHandle private_node, pipeline::ScanOdometry& odometry,
                                   const bridge::OdometryOutput& output,
                                   diagnostic_updater::Updater& updater)
    : odometry_(odometry), output_(output) {
  updater.add("odometry", this, &OdometryControls::report);
  reset_server_ = private_node.advertiseService("reset", &OdometryControls::onReset, this);
}

void OdometryControls::note(const pipeline::Estimates& estimates) {
  if (!estimates.odometry) return;
  last_ = *estimates.odometry;
  is_mounting_known_ = estimates.located.T_base_sensor.has_value();
  if (!is_mounting_known_) {
    ROS_WARN_ONCE("the scanner is taken for the base: %s", estimates.located.no_odometry.c_str());
  }
  if (!last_.isFlagged() || !flagged_.isDue()) return;
  ROS_WARN("scan %.3f: match %s, %.0f %% of %zu beams found their counterpart",
           bridge::timeOf(last_.stamp).toSec(), bridge::nameOf(last_.state), 100.0 * last_.inliers,
           last_.beams);
}

bool OdometryControls::onReset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  odometry_.reset();
  response.success = true;
  response.message = "odometry starts anew with the next scan";
  return true;
}

void OdometryControls::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::size_t flagged =
      output_.count(MatchState::kAmbiguous) + output_.count(MatchState::kRecovered) +
      output_.count(MatchState::kFailed) + output_.count(MatchState::kUnbound);
  if (last_.stamp == 0) {
    status.summary(DiagnosticStatus::WARN, "no scan used yet");
  } else if (flagged == flagged_before_) {
    status.summary(DiagnosticStatus::OK, "scans match");
  } else if (last_.state == MatchState::kFailed) {
    status.summary(DiagnosticStatus::ERROR, "the last scan does not match: bridged");
  } else {
    status.summary(DiagnosticStatus::WARN, "some of the last scans were doubtful");
  }
  flagged_before_ = flagged;
  for (const MatchState state :
       {MatchState::kInitial, MatchState::kMatched, MatchState::kAmbiguous, MatchState::kRecovered,
        MatchState::kFailed, MatchState::kUnbound}) {
    status.add(bridge::nameOf(state), output_.count(state));
  }
  const auto& floor = odometry_.beamsOnFloor();
  status.add("beams in the last scan", last_.beams);
  status.add("share of them matched", last_.inliers);
  status.add("beams on floor or ceiling", std::count(floor.begin(), floor.end(), true));
  status.add("mounting", is_mounting_known_ ? "from tf" : "none: the scanner is the base");
}

}  // namespace sightline::nodes
