#include "sightline/bridge/odometry_output.h"

#include <numeric>

#include <fmt/format.h>

#include "sightline/bridge/laser_odometry_messages.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline::bridge {

using dead_reckoning::MatchState;

OdometryOutput::OdometryOutput(Output& output, const pipeline::Frames& frames, bool publish_tf)
    : frames_(frames),
      publish_tf_(publish_tf),
      odometry_(output.open<nav_msgs::Odometry>("laser_odom")),
      transforms_(publish_tf ? output.openTransforms() : Port<tf2_msgs::TFMessage>()) {}

std::string OdometryOutput::write(const pipeline::Estimates& estimates) {
  ++scans_;
  const auto& update = estimates.odometry;
  if (!update) {
    ++left_out_;
    ++without_pose_[estimates.no_odometry];
    return estimates.no_odometry;
  }
  ++states_[static_cast<std::size_t>(update->state)];
  if (estimates.located.T_odom_base) ++with_wheels_;
  odometry_.write(toLaserOdometryMessage(*update, frames_.odom, frames_.base));
  // One transform for each time, as in RoomOutput.
  if (!publish_tf_ || update->stamp == sent_) return "";
  sent_ = update->stamp;
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {
      toTransformMessage(frames_.odom, frames_.base, update->stamp, update->pose.mean)};
  transforms_.write(transforms);
  return "";
}

std::vector<std::string> OdometryOutput::summary() const {
  const std::size_t poses = std::accumulate(states_.begin(), states_.end(), std::size_t{0});
  const std::size_t flagged = count(MatchState::kAmbiguous) + count(MatchState::kRecovered) +
                              count(MatchState::kFailed) + count(MatchState::kUnbound);
  std::vector<std::string> lines{fmt::format(
      "odometry: {} of {} scans have a pose, {} of them flagged, {} with the wheels as prior",
      poses, scans_, flagged, with_wheels_)};
  for (const auto& [reason, count] : without_pose_) {
    lines.push_back(fmt::format("odometry: {} scans left out: {}", count, reason));
  }
  return lines;
}

}  // namespace sightline::bridge
