#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sightline/simulation/path.h"
#include "sightline/targets/search.h"

namespace sightline::pipeline {

/// Robots that follow the ways that a search chooses for them: decides when ways are chosen anew,
/// and steers. Robots come and go.
class SearchingTeam {
 public:
  /// A robot without a look for `max_gone` [s] has left.
  SearchingTeam(targets::Search search, const targets::SearchConfig& config, double max_gone);

  targets::Search& search() { return search_; }
  /// A look from where its robot is now.
  void look(const std::string& robot, const targets::BearingSet& set);
  /// Chooses ways at a time [ns] where it is due; returns the robots that have a new one.
  std::vector<std::string> plan(std::int64_t now);
  const targets::SearchAction& actionOf(const std::string& robot) const {
    return robots_.at(robot).action;
  }
  std::vector<targets::SearchAction> actions() const;
  /// Velocity along the robot's way; none where it has no way, or its last look is half a second
  /// old.
  simulation::Velocity steer(const std::string& robot, std::int64_t now);
  std::size_t present(std::int64_t now) const;
  /// Forgets all: the clock was set back.
  void reset();

 private:
  struct Robot {
    geometry::Pose2 T_map_sensor;
    std::int64_t stamp = 0;
    targets::SearchAction action;  // without poses: none
    std::optional<simulation::PathFollower> follower;
  };
  bool isPresent(const Robot& robot, std::int64_t now) const;
  bool hasArrived(const Robot& robot) const;
  void send(Robot& robot, const targets::SearchAction& action);

  targets::Search search_;
  targets::SearchConfig config_;
  std::int64_t max_gone_;
  std::int64_t planned_ = 0;  // when ways were chosen last
  std::map<std::string, Robot> robots_;
};

}  // namespace sightline::pipeline
