#include "sightline/bridge/laser_odometry_messages.h"

#include "sightline/bridge/odometry_conversion.h"

namespace sightline::bridge {

nav_msgs::Odometry toLaserOdometryMessage(const dead_reckoning::DeadReckoningUpdate& update,
                                          const std::string& odom_frame,
                                          const std::string& base_frame) {
  return toOdometryMessage({update.stamp, odom_frame, base_frame}, update.pose, update.twist);
}

const char* nameOf(dead_reckoning::MatchState state) {
  using dead_reckoning::MatchState;
  switch (state) {
    case MatchState::kInitial:
      return "initial";
    case MatchState::kMatched:
      return "matched";
    case MatchState::kAmbiguous:
      return "ambiguous";
    case MatchState::kRecovered:
      return "recovered";
    case MatchState::kUnbound:
      return "unbound";
    case MatchState::kFailed:
      break;
  }
  return "failed";
}

}  // namespace sightline::bridge
