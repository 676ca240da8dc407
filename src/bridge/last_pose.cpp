#include "sightline/bridge/last_pose.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "sightline/config/node.h"

namespace sightline::bridge {

namespace {

constexpr std::int64_t kKeptFor = 1'000'000'000;  // [ns]

}  // namespace

std::optional<geometry::Pose2> LastPose::read() const {
  if (path_.empty() || !std::filesystem::exists(path_)) return std::nullopt;
  return config::Node::readFile(path_).at("initial_pose").pose();
}

bool LastPose::keep(const tracking::TrackerUpdate& update) {
  if (path_.empty() || update.state != tracking::TrackerState::kTracking) return true;
  if (kept_at_ && std::abs(update.stamp - *kept_at_) < kKeptFor) return true;
  kept_at_ = update.stamp;
  return write(update.pose.mean);
}

// Whole or not at all, also where the power goes meanwhile.
bool LastPose::write(const geometry::Pose2& T_map_base) const {
  const std::string unfinished = path_ + ".new";
  std::ofstream file(unfinished);
  file << fmt::format("initial_pose: [{:.6f}, {:.6f}, {:.6f}]   # m, m, rad\n", T_map_base.x(),
                      T_map_base.y(), T_map_base.theta());
  file.close();
  std::error_code fault;
  if (file) std::filesystem::rename(unfinished, path_, fault);
  return file && !fault;
}

}  // namespace sightline::bridge
