#include "sightline/bridge/recorded_estimates.h"

#include <filesystem>

namespace sightline::bridge {

RecordedEstimates::RecordedEstimates(const pipeline::EstimatorsConfig& config,
                                     const pipeline::EstimatorSet& set, const std::string& folder)
    : set_(set), folder_(folder), estimators_(config, set) {
  const std::filesystem::path path(folder);
  bag_.open((path / "out.bag").string(), rosbag::bagmode::Write);
  if (set.lines) lines_.emplace(output_, config.input);
  if (set.features) features_.emplace(output_, config.frames);
  if (set.rooms) {
    rooms_.emplace(output_, RoomOutputConfig{}, config.frames, *config.rooms,
                   estimators_.rooms()->map());
    rooms_trajectory_.emplace((path / "rooms.tum").string());
  }
  if (set.odometry) {
    odometry_.emplace(output_, config.frames, /*publish_tf=*/false);
    odometry_trajectory_.emplace((path / "odometry.tum").string());
  }
}

void RecordedEstimates::take(pipeline::LocatedScan located, const ros::Time& now) {
  now_ = now;
  const pipeline::Estimates estimates = estimators_.take(std::move(located));
  if (lines_) lines_->write(estimates);
  if (features_) features_->write(estimates);
  if (rooms_) rooms_->write(estimates, /*has_pose=*/true);
  if (odometry_) odometry_->write(estimates);
  if (rooms_ && estimates.rooms) {
    rooms_trajectory_->add(estimates.rooms->stamp, estimates.rooms->pose.mean);
  }
  if (odometry_ && estimates.odometry) {
    odometry_trajectory_->add(estimates.odometry->stamp, estimates.odometry->pose.mean);
  }
}

void RecordedEstimates::copy(const rosbag::MessageInstance& message) {
  bag_.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
}

void RecordedEstimates::close() {
  if (rooms_trajectory_) rooms_trajectory_->close();
  if (rooms_) rooms_->writeWalls((std::filesystem::path(folder_) / "walls.csv").string());
  if (odometry_trajectory_) odometry_trajectory_->close();
  bag_.close();
}

std::vector<EstimatorCount> RecordedEstimates::counts() const {
  std::vector<EstimatorCount> counts;
  if (lines_) counts.push_back(lines_->counted());
  if (rooms_) counts.push_back(rooms_->counted());
  if (odometry_) counts.push_back(odometry_->counted());
  return counts;
}

std::vector<std::string> RecordedEstimates::summary() const {
  std::vector<std::string> lines;
  const auto append = [&](const auto& output) {
    if (!output) return;
    for (auto& line : output->summary()) lines.push_back(std::move(line));
  };
  append(lines_);
  append(features_);
  append(rooms_);
  append(odometry_);
  return lines;
}

}  // namespace sightline::bridge
