#pragma once

#include <map>
#include <string>
#include <vector>

#include "sightline/bridge/output.h"
#include "sightline/bridge/target_messages.h"
#include "sightline/pipeline/bearing_feed.h"
#include "sightline/pipeline/targets_config.h"
#include "sightline/targets/target_tracker.h"

namespace sightline::bridge {

/// Runs the target tracker on the looks of a feed and writes what it finds: `targets`, and for
/// people `target_markers` and `target_intensity`.
class TargetOutput {
 public:
  /// `output` and `transforms` have to live as long. Throws config::Error.
  TargetOutput(Output& output, const pipeline::TargetsConfig& config,
               const pipeline::Transforms& transforms);

  pipeline::BearingFeed& feed() { return feed_; }
  /// Hands over the looks that are ready at a time [ns], and writes what is found. Returns the
  /// robots whose looks were refused, with the reason.
  std::vector<std::pair<std::string, std::string>> run(std::int64_t now);
  /// Forgets all: the clock was set back.
  void reset();

  std::size_t used() const { return used_; }
  std::vector<std::string> summary() const;
  /// Called with each estimate that is written.
  std::function<void(const targets::TargetEstimate&)> listener;

 private:
  std::string take(const pipeline::BearingFeed::Ready& look);
  void write();

  pipeline::TargetsConfig config_;
  pipeline::BearingFeed feed_;
  targets::TargetTracker tracker_;
  Port<TargetArray> targets_;
  Port<visualization_msgs::MarkerArray> markers_;
  Port<nav_msgs::OccupancyGrid> intensity_;
  std::size_t used_ = 0;
  std::size_t spared_ = 0;
  std::map<std::string, std::size_t> refused_;  // by reason
  std::int64_t written_ = 0;                    // stamp of the newest output
  std::int64_t drawn_ = 0;                      // of the intensity
};

}  // namespace sightline::bridge
