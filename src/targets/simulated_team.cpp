#include "sightline/targets/simulated_team.h"

#include <algorithm>
#include <cmath>

namespace sightline::targets {

namespace {

double normal(std::mt19937_64& random, double sigma) {
  return sigma * std::normal_distribution<double>()(random);
}

double lastingSigma(const BearingConfig& bearing) {
  return std::sqrt(bearing.lasting_share) * bearing.sigma;
}

constexpr std::uint64_t kSamplerSeed = 0x9e3779b97f4a7c15ULL;

}  // namespace

void TeamConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("size", size, {"m", {1.0, 1e4}, "edge of the square in which all takes place"});
  visitor.integer("targets", targets, {"-", {0, 10000}, "number of targets"});
  visitor.number("spacing", spacing, {"m", {0.0, 1e6}, "least distance of two targets"});
  visitor.integer("robots", robots, {"-", {1, 1000}, "number of robots"});
  visitor.number("speed", speed, {"m/s", {0.0, 1e6}, "of the robots"});
  visitor.number("period", period, {"s", {1e-3, 1e3}, "time between two looks of a robot"});
  visitor.number("position_sigma", position_sigma,
                 {"m", {0.0, 1e6}, "error of the reported poses, in x and in y"});
  visitor.number("heading_sigma", heading_sigma,
                 {"rad", {0.0, 1e6}, "error of the reported headings"});
  visitor.number("pose_correlation", pose_correlation,
                 {"s", {1e-6, 1e6}, "time constant of the errors of the poses"});
  visitor.integer("blind_looks", blind_looks,
                  {"-", {1, 100000}, "looks for which a target stays visible or hidden"});
  visitor.group("model", model);
}

BearingSampler::BearingSampler(const SensorModel& model, std::uint64_t seed)
    : model_(model), random_(seed) {}

double BearingSampler::uniform(double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random_);
}

double BearingSampler::clutterBearing() {
  const ClutterConfig& clutter = model_.config().clutter;
  const FieldOfView& view = model_.config().field_of_view;
  if (uniform(0.0, 1.0) < clutter.uniform_share) return uniform(view.min, view.max);
  const double side = uniform(0.0, 1.0) < 0.5 ? -0.5 : 0.5;
  return side * geometry::kPi + uniform(-0.5, 0.5) * clutter.peak_width;
}

int BearingSampler::clutterCount() {
  const double mean = model_.clutterMean();
  return mean > 0.0 ? std::poisson_distribution<int>(mean)(random_) : 0;
}

void BearingSampler::add(double bearing, std::optional<std::size_t> origin, SimulatedSet& set) {
  set.set.bearings.push_back(geometry::wrapAngle(bearing));
  set.origins.push_back(origin);
}

void BearingSampler::sample(const std::vector<Eigen::Vector2d>& targets_map,
                            const std::vector<bool>& visible, double lasting, SimulatedSet& set) {
  const BearingConfig& bearing = model_.config().bearing;
  const double shared = std::max(bearing.common_share, bearing.lasting_share);
  const double own_sigma = std::sqrt(1.0 - shared) * bearing.sigma;
  const double offset =
      shared > bearing.lasting_share
          ? lasting + normal(random_, std::sqrt(shared - bearing.lasting_share) * bearing.sigma)
          : lasting;
  const double share = model_.config().visibility.share;
  const geometry::Pose2 T_sensor_map = set.T_map_sensor.inverse();
  for (std::size_t i = 0; i < targets_map.size(); ++i) {
    if (!visible[i]) continue;
    const double detection = model_.detection(targets_map[i], set.T_map_sensor) / share;
    if (detection <= 0.0 || uniform(0.0, 1.0) >= detection) continue;
    const Polar place = polarOf(T_sensor_map * targets_map[i]);
    add(place.bearing + bearing.biasAt(place.bearing) + offset + normal(random_, own_sigma), i,
        set);
  }
  const int clutter = clutterCount();
  for (int i = 0; i < clutter; ++i) add(clutterBearing(), std::nullopt, set);
}

SimulatedTeam::SimulatedTeam(const TeamConfig& config, std::uint64_t seed,
                             std::shared_ptr<const LineOfSight> sight)
    : config_(config),
      model_(config.model, std::move(sight)),
      random_(seed),
      sampler_(model_, seed ^ kSamplerSeed) {
  config::validate(config_);
  placeTargets();
  members_.resize(static_cast<std::size_t>(config_.robots));
  for (Member& member : members_) {
    const Eigen::Vector2d start = place(0.0);
    member.goal = place(0.0);
    const Eigen::Vector2d way = member.goal - start;
    member.T_map_sensor = {start, std::atan2(way.y(), way.x())};
    member.error = {normal(random_, config_.position_sigma),
                    normal(random_, config_.position_sigma),
                    normal(random_, config_.heading_sigma)};
    const double lasting = lastingSigma(config_.model.bearing);
    if (lasting > 0.0) member.lasting = normal(random_, lasting);
  }
}

Eigen::Vector2d SimulatedTeam::place(double margin) {
  std::uniform_real_distribution<double> uniform(margin, config_.size - margin);
  const double x = uniform(random_);
  return {x, uniform(random_)};
}

void SimulatedTeam::placeTargets() {
  constexpr double kMargin = 0.5;
  while (targets_map_.size() < static_cast<std::size_t>(config_.targets)) {
    const Eigen::Vector2d drawn = place(kMargin);
    const bool is_apart = std::all_of(
        targets_map_.begin(), targets_map_.end(),
        [&](const Eigen::Vector2d& other) { return (other - drawn).norm() >= config_.spacing; });
    if (is_apart) targets_map_.push_back(drawn);
  }
}

// Drives straight to the goal, and turns on the spot towards the next one.
void SimulatedTeam::drive(Member& member) {
  double left = config_.speed * config_.period;
  Eigen::Vector2d at = member.T_map_sensor.translation();
  double heading = member.T_map_sensor.theta();
  while (left > 0.0) {
    const Eigen::Vector2d way = member.goal - at;
    const double step = std::min(left, way.norm());
    if (step > 0.0) heading = std::atan2(way.y(), way.x());
    at += step * Eigen::Vector2d(std::cos(heading), std::sin(heading));
    left -= step;
    if (left > 0.0 && member.is_sent) break;
    if (left > 0.0) member.goal = place(0.0);
  }
  member.T_map_sensor = {at, heading};
}

void SimulatedTeam::drift(Member& member) {
  const double kept = std::exp(-config_.period / config_.pose_correlation);
  const double fresh = std::sqrt(1.0 - kept * kept);
  const Eigen::Vector3d sigma(config_.position_sigma, config_.position_sigma,
                              config_.heading_sigma);
  for (int i = 0; i < 3; ++i) {
    member.error[i] = kept * member.error[i] + normal(random_, fresh * sigma[i]);
  }
  const BearingConfig& bearing = config_.model.bearing;
  if (bearing.lasting_share == 0.0) return;
  const double lasts = std::exp(-config_.period / bearing.lasting_duration);
  member.lasting = lasts * member.lasting +
                   normal(random_, std::sqrt(1.0 - lasts * lasts) * lastingSigma(bearing));
}

void SimulatedTeam::redrawVisibility(Member& member) {
  if (member.looks++ % config_.blind_looks != 0) return;
  std::bernoulli_distribution is_visible(config_.model.visibility.share);
  member.visible.resize(targets_map_.size());
  for (std::size_t i = 0; i < member.visible.size(); ++i) member.visible[i] = is_visible(random_);
}

SimulatedSet SimulatedTeam::look(std::size_t robot) {
  Member& member = members_[robot];
  redrawVisibility(member);
  SimulatedSet set;
  set.T_map_sensor = member.T_map_sensor;
  set.set.robot = robot;
  set.set.stamp = time_;
  set.set.T_map_sensor.mean =
      geometry::Pose2(Eigen::Vector3d(member.T_map_sensor.coordinates() + member.error));
  const double position = config_.position_sigma * config_.position_sigma;
  set.set.T_map_sensor.covariance =
      Eigen::Vector3d(position, position, config_.heading_sigma * config_.heading_sigma)
          .asDiagonal();
  set.set.field_of_view = model_.config().field_of_view;
  set.set.range_max = model_.config().detection.range_max;
  sampler_.sample(targets_map_, member.visible, member.lasting, set);
  return set;
}

void SimulatedTeam::send(std::size_t robot, const Eigen::Vector2d& place_map) {
  members_[robot].goal = place_map;
  members_[robot].is_sent = true;
}

bool SimulatedTeam::hasArrived(std::size_t robot) const {
  constexpr double kThere = 1e-6;
  const Member& member = members_[robot];
  return member.is_sent && (member.goal - member.T_map_sensor.translation()).norm() < kThere;
}

std::vector<SimulatedSet> SimulatedTeam::step() {
  std::vector<SimulatedSet> sets;
  for (std::size_t robot = 0; robot < members_.size(); ++robot) sets.push_back(look(robot));
  for (Member& member : members_) {
    drive(member);
    drift(member);
  }
  time_ += std::llround(1e9 * config_.period);
  return sets;
}

}  // namespace sightline::targets
