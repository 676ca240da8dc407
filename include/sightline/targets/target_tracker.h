#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sightline/targets/target_filter.h"
#include "sightline/targets/target_tracker_config.h"

namespace sightline::targets {

/// Result of a look that was handed to the tracker.
enum class LookOutcome {
  kUsed,     ///< the filter has taken it
  kSpared,   ///< it tells nothing new: the robot has not moved since its last one
  kRefused,  ///< it cannot be used
};

/// Tracks targets by the looks of any number of robots, which come and go by name: checks each
/// look, spares those that tell nothing new, explains team mates, and hands the rest to the filter.
/// Not thread-safe.
class TargetTracker {
 public:
  /// Reads the files that the settings name. Throws config::Error.
  explicit TargetTracker(const TargetTrackerConfig& config);

  struct Verdict {
    LookOutcome outcome = LookOutcome::kUsed;
    std::string reason;  ///< of a refusal
  };
  /// `set.robot` and `set.known` are filled in here. Looks may come late by the settings' max_age.
  Verdict take(const std::string& robot, BearingSet set);

  TargetEstimate estimate() { return filter_->estimate(); }
  IntensityGrid intensity() const { return filter_->intensity(); }
  /// Forgets targets and robots, as after the clock was set back.
  void reset();

 private:
  struct Robot {
    std::size_t index = 0;
    SensorModel model;
    geometry::UncertainPose2 T_map_sensor;  // newest
    std::int64_t stamp = 0;
    std::optional<geometry::Pose2> counted;  // where its last look counted
    std::int64_t counted_stamp = 0;
  };
  Robot& robotOf(const std::string& name);
  std::string faultOf(const BearingSet& set) const;
  bool isNew(const Robot& robot, const BearingSet& set) const;
  void addMates(const Robot& robot, BearingSet& set) const;

  TargetTrackerConfig config_;
  SensorModelsConfig models_;
  std::shared_ptr<const LineOfSight> sight_;
  std::unique_ptr<TargetFilter> filter_;
  std::map<std::string, Robot> robots_;
  std::int64_t newest_ = 0;
};

}  // namespace sightline::targets
