#include "sightline/pipeline/searching_team.h"

#include <algorithm>
#include <cmath>

namespace sightline::pipeline {

SearchingTeam::SearchingTeam(targets::Search search, const targets::SearchConfig& config,
                             double max_gone)
    : search_(std::move(search)), config_(config), max_gone_(std::llround(1e9 * max_gone)) {}

void SearchingTeam::reset() {
  search_.reset();
  robots_.clear();
  planned_ = 0;
}

void SearchingTeam::look(const std::string& robot, const targets::BearingSet& set) {
  Robot& known = robots_[robot];
  if (set.stamp < known.stamp) return;
  known.stamp = set.stamp;
  known.T_map_sensor = set.T_map_sensor.mean;
  search_.look(robot, set);
}

bool SearchingTeam::isPresent(const Robot& robot, std::int64_t now) const {
  return now - robot.stamp <= max_gone_;
}

std::size_t SearchingTeam::present(std::int64_t now) const {
  return static_cast<std::size_t>(
      std::count_if(robots_.begin(), robots_.end(),
                    [&](const auto& entry) { return isPresent(entry.second, now); }));
}

bool SearchingTeam::hasArrived(const Robot& robot) const {
  constexpr double kThere = 0.25;
  if (robot.action.poses.empty()) return true;
  const Eigen::Vector2d end = robot.action.poses.back().translation();
  return (end - robot.T_map_sensor.translation()).norm() < kThere;
}

void SearchingTeam::send(Robot& robot, const targets::SearchAction& action) {
  constexpr double kAcceleration = 0.5;
  robot.action = action;
  simulation::Path path;
  path.speed = config_.actions.speed;
  path.turn_rate = config_.actions.turn_rate;
  path.tolerance = 0.2;
  path.waypoints_map = {action.poses.back().translation()};
  robot.follower.emplace(path, kAcceleration);
}

std::vector<std::string> SearchingTeam::plan(std::int64_t now) {
  const bool is_anew = config_.replan > 0.0 && config_.gain == targets::SearchGain::kDetections &&
                       now - planned_ >= std::llround(1e9 * config_.replan);
  std::vector<targets::Search::Robot> due;
  for (const auto& [name, robot] : robots_) {
    if (isPresent(robot, now) && (is_anew || hasArrived(robot))) {
      due.push_back({name, robot.T_map_sensor});
    }
  }
  if (is_anew) planned_ = now;
  const auto choices = search_.plan(due);
  std::vector<std::string> changed;
  for (std::size_t i = 0; i < due.size(); ++i) {
    if (!choices[i]) continue;
    send(robots_[due[i].name], choices[i]->action);
    changed.push_back(due[i].name);
  }
  return changed;
}

std::vector<targets::SearchAction> SearchingTeam::actions() const {
  std::vector<targets::SearchAction> result;
  for (const auto& [name, robot] : robots_) {
    if (!robot.action.poses.empty()) result.push_back(robot.action);
  }
  return result;
}

simulation::Velocity SearchingTeam::steer(const std::string& robot, std::int64_t now) {
  constexpr std::int64_t kStale = 500'000'000;  // a robot that does not know where it is stands
  const auto found = robots_.find(robot);
  if (found == robots_.end() || !found->second.follower) return {};
  if (now - found->second.stamp > kStale) return {};
  return found->second.follower->steer(found->second.T_map_sensor);
}

}  // namespace sightline::pipeline
