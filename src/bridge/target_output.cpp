#include "sightline/bridge/target_output.h"

#include <cmath>

#include <fmt/format.h>

namespace sightline::bridge {

TargetOutput::TargetOutput(Output& output, const pipeline::TargetsConfig& config,
                           const pipeline::Transforms& transforms)
    : config_(config),
      feed_(config, transforms),
      tracker_(config.tracker),
      targets_(output.open<TargetArray>("targets")) {
  if (output.isBag()) return;
  markers_ = output.open<visualization_msgs::MarkerArray>("target_markers");
  intensity_ = output.open<nav_msgs::OccupancyGrid>("target_intensity");
}

void TargetOutput::reset() {
  feed_.clear();
  tracker_.reset();
  written_ = 0;
  drawn_ = 0;
}

// The reason of a refusal, or nothing.
std::string TargetOutput::take(const pipeline::BearingFeed::Ready& look) {
  if (!look.fault.empty()) return look.fault;
  const auto verdict = tracker_.take(look.robot, look.set);
  if (verdict.outcome == targets::LookOutcome::kRefused) return verdict.reason;
  if (verdict.outcome == targets::LookOutcome::kSpared) {
    ++spared_;
    return "";
  }
  ++used_;
  write();
  return "";
}

std::vector<std::pair<std::string, std::string>> TargetOutput::run(std::int64_t now) {
  std::vector<std::pair<std::string, std::string>> refusals;
  for (const auto& look : feed_.ready(now)) {
    const std::string reason = take(look);
    if (reason.empty()) continue;
    ++refused_[reason];
    refusals.emplace_back(look.robot, reason);
  }
  return refusals;
}

void TargetOutput::write() {
  constexpr std::int64_t kDrawing = 1'000'000'000;
  const targets::TargetEstimate estimate = tracker_.estimate();
  if (written_ > 0 && estimate.stamp < written_ + std::llround(1e9 * config_.period)) return;
  written_ = estimate.stamp;
  targets_.write(toMessage(estimate, config_.map_frame));
  if (listener) listener(estimate);
  if (!markers_.write) return;
  if (markers_.is_wanted()) markers_.write(toMarkers(estimate, config_.map_frame));
  if (!intensity_.is_wanted() || estimate.stamp < drawn_ + kDrawing) return;
  drawn_ = estimate.stamp;
  intensity_.write(toMessage(tracker_.intensity(), estimate.stamp, config_.map_frame));
}

std::vector<std::string> TargetOutput::summary() const {
  std::vector<std::string> lines{fmt::format(
      "targets: {} looks used, {} more from where their robot had looked before", used_, spared_)};
  for (const auto& [reason, count] : refused_) {
    lines.push_back(fmt::format("targets: {} looks left out: {}", count, reason));
  }
  return lines;
}

}  // namespace sightline::bridge
