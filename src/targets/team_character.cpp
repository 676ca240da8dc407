#include <algorithm>
#include <cmath>

#include "sightline/targets/characterization.h"

namespace sightline::targets {

namespace {

// Weighted sums of what robots have in common.
struct TeamSums {
  double squares = 0.0;  // of errors about each robot's own bias
  double biases = 0.0;
  double bias_squares = 0.0;
  RobotCharacter mean;

  void add(const RobotCharacter& robot, double share);
};

void TeamSums::add(const RobotCharacter& robot, double share) {
  squares += share * std::pow(robot.errors.sigma * robot.errors.tail, 2);
  biases += share * robot.errors.bias;
  bias_squares += share * robot.errors.bias * robot.errors.bias;
  mean.errors.lag += share * robot.errors.lag;
  mean.errors.jitter += share * robot.errors.jitter;
  mean.clutter_mean += share * robot.clutter_mean;
  mean.error_inflation += share * (robot.error_inflation - 1.0);
  mean.shared.common_share += share * robot.shared.common_share;
  mean.shared.lasting_share += share * robot.shared.lasting_share;
  mean.shared.lasting_duration += share * robot.shared.lasting_duration;
  mean.visibility.share += share * (robot.visibility.share - 1.0);
  mean.visibility.duration += share * robot.visibility.duration;
  for (std::size_t i = 0; i < robot.table.probabilities.size(); ++i) {
    mean.table.probabilities[i] += share * robot.table.probabilities[i];
  }
}

}  // namespace

RobotCharacter teamCharacter(const std::map<std::string, RobotCharacter>& robots) {
  double tried = 0.0;
  for (const auto& [name, robot] : robots) tried += static_cast<double>(robot.opportunities);
  TeamSums sums;
  sums.mean.visibility.duration = 0.0;
  sums.mean.shared.lasting_duration = 0.0;
  sums.mean.table = robots.begin()->second.table;
  sums.mean.place_sigma = robots.begin()->second.place_sigma;
  std::fill(sums.mean.table.probabilities.begin(), sums.mean.table.probabilities.end(), 0.0);
  for (const auto& [name, robot] : robots) {
    sums.add(robot, static_cast<double>(robot.opportunities) / std::max(tried, 1.0));
  }
  RobotCharacter team = sums.mean;
  // A robot that is not among them has a bias of its own.
  const double spread = std::max(0.0, sums.bias_squares - sums.biases * sums.biases);
  team.errors.bias = sums.biases;
  team.errors.sigma = std::sqrt(sums.squares + spread);
  return team;
}

}  // namespace sightline::targets
