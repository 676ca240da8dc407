#include "sightline/bridge/recorded_targets.h"

#include <filesystem>

#include <fmt/format.h>

#include "sightline/bridge/time.h"

namespace sightline::bridge {

namespace {

std::string inFolder(const std::string& folder, const char* name) {
  return (std::filesystem::path(folder) / name).string();
}

}  // namespace

RecordedTargets::RecordedTargets(const std::vector<std::string>& paths,
                                 const pipeline::TargetsConfig& config, const std::string& folder)
    : bags_(paths, config),
      out_(inFolder(folder, "out.bag"), rosbag::bagmode::Write),
      log_(inFolder(folder, "targets.csv")),
      output_(bag_output_, config, bags_.transforms()) {
  output_.listener = [this](const targets::TargetEstimate& estimate) { log_.add(estimate); };
}

void RecordedTargets::read(const std::function<void(double)>& progress) {
  bags_.read(output_.feed(), [&](const ros::Time& now, double ratio) {
    now_ = now;
    output_.run(nanoseconds(now));
    progress(ratio);
  });
  log_.close();
  out_.close();
}

std::vector<std::string> RecordedTargets::summary() const {
  std::vector<std::string> lines = output_.summary();
  for (const auto& [reason, count] : bags_.refused()) {
    lines.push_back(fmt::format("{} messages left out: {}", count, reason));
  }
  return lines;
}

}  // namespace sightline::bridge
