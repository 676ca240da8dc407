#include "sightline/targets/search.h"

#include <algorithm>
#include <cmath>

namespace sightline::targets {

void SearchConfig::visit(config::FieldVisitor& visitor) {
  visitor.choice("gain", gain, {"detections", "information", "random"},
                 "by which ways are chosen: expected new detections a second; the information of "
                 "the paper's control law; or at random");
  visitor.group("actions", actions);
  visitor.group("undetected", undetected);
  visitor.number(
      "replan", replan,
      {"s",
       {0.0, 1e6},
       "after which ways are chosen anew, by detections; 0, and the others: at their ends"});
  visitor.integer("seed", seed, {"1", {0, 1e9}, "of ways that are chosen at random"});
}

ExpectedTargets::ExpectedTargets(const IntensityGrid& grid) : grid_(&grid) {
  const double area = grid.resolution * grid.resolution;
  for (const double density : grid.cells) numbers_.push_back(area * density);
}

void ExpectedTargets::add(const Eigen::Vector2d& place_map, double mass) {
  const Eigen::Vector2d cell = (place_map - grid_->origin) / grid_->resolution;
  if (!(cell.x() >= 0.0 && cell.y() >= 0.0)) return;
  const auto column = static_cast<std::size_t>(cell.x());
  const auto row = static_cast<std::size_t>(cell.y());
  if (column < grid_->width && row < grid_->height) numbers_[row * grid_->width + column] += mass;
}

// Calls visit(cell, probability of detection) for the cells in view that targets may be in.
template <class Visit>
void ExpectedTargets::visitInView(const geometry::Pose2& T_map_sensor, const SensorModel& model,
                                  const Visit& visit) const {
  const double reach = model.config().detection.range_max;
  const geometry::Pose2 T_sensor_map = T_map_sensor.inverse();
  const Eigen::Vector2d low = (T_map_sensor.translation() - grid_->origin).array() - reach;
  const auto first = [&](double from, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp(std::floor(from / grid_->resolution), 0.0, static_cast<double>(count)));
  };
  const double span = 2.0 * reach + grid_->resolution;
  for (std::size_t row = first(low.y(), grid_->height); row < first(low.y() + span, grid_->height);
       ++row) {
    for (std::size_t column = first(low.x(), grid_->width);
         column < first(low.x() + span, grid_->width); ++column) {
      const std::size_t cell = row * grid_->width + column;
      if (numbers_[cell] <= 0.0) continue;
      const Eigen::Vector2d place =
          grid_->origin + grid_->resolution * Eigen::Vector2d(static_cast<double>(column) + 0.5,
                                                              static_cast<double>(row) + 0.5);
      const double detection = model.detection(polarOf(T_sensor_map * place));
      if (detection > 0.0 && model.isInSight(place, T_map_sensor)) visit(cell, detection);
    }
  }
}

double ExpectedTargets::take(const geometry::Pose2& T_map_sensor, const SensorModel& model) {
  double taken = 0.0;
  visitInView(T_map_sensor, model, [&](std::size_t cell, double detection) {
    taken += detection * numbers_[cell];
    numbers_[cell] *= 1.0 - detection;
  });
  return taken;
}

ExpectedTargets::InView ExpectedTargets::inView(const geometry::Pose2& T_map_sensor,
                                                const SensorModel& model) const {
  InView view;
  visitInView(T_map_sensor, model, [&](std::size_t cell, double detection) {
    view.all += numbers_[cell];
    view.detected += detection * numbers_[cell];
  });
  return view;
}

namespace {

double binaryEntropy(double p) {
  const double q = 1.0 - p;
  return -(p > 0.0 ? p * std::log(p) : 0.0) - (q > 0.0 ? q * std::log(q) : 0.0);
}

}  // namespace

double emptinessInformation(const ExpectedTargets::InView& view, double clutter_mean) {
  if (view.all <= 0.0) return 0.0;
  const double detection = std::min(view.detected / view.all, 1.0);
  const double empty_of_clutter = std::exp(-clutter_mean);
  const double of_all = binaryEntropy(empty_of_clutter * std::exp(-view.detected));
  // Mean over the number in view of what is left when it is known.
  double given = 0.0;
  double probability = std::exp(-view.all);
  double empty = empty_of_clutter;
  const int most = 10 + static_cast<int>(view.all + 6.0 * std::sqrt(view.all));
  for (int number = 0; number <= most; ++number) {
    given += probability * binaryEntropy(empty);
    probability *= view.all / (number + 1.0);
    empty *= 1.0 - detection;
  }
  return std::max(of_all - given, 0.0);
}

Search::Search(const SearchConfig& config, const SensorModelsConfig& models,
               std::shared_ptr<const LineOfSight> sight)
    : config_(config),
      models_config_(models),
      sight_(std::move(sight)),
      actions_(config.actions, sight_),
      undetected_(config.undetected),
      random_(static_cast<std::uint64_t>(config.seed)) {
  config::validate(config_);
  config_.undetected.check("");
}

void Search::reset() {
  undetected_ = Undetected(config_.undetected);
  targets_.clear();
}

const SensorModel& Search::modelOf(const std::string& robot) {
  const auto known = models_.find(robot);
  if (known != models_.end()) return known->second;
  const auto own = models_config_.robots.find(robot);
  const SensorModelConfig& config =
      own == models_config_.robots.end() ? models_config_.common : own->second;
  return models_.emplace(robot, SensorModel(config, sight_)).first->second;
}

void Search::look(const std::string& robot, const BearingSet& set) {
  const SensorModel& model = modelOf(robot);
  undetected_.look(set.T_map_sensor.mean, model,
                   set.field_of_view.within(model.config().field_of_view));
}

// Ways may lead to where the account does not reach yet.
void Search::coverReach(const Robot& robot) {
  const auto& lengths = config_.actions.lengths;
  const double reach = *std::max_element(lengths.begin(), lengths.end()) +
                       modelOf(robot.name).config().detection.range_max;
  undetected_.cover(robot.T_map_sensor.translation(), reach);
}

double Search::gainOf(const SearchAction& action, const SensorModel& model,
                      const ExpectedTargets& expected) const {
  ExpectedTargets left = expected;
  double gain = 0.0;
  for (const geometry::Pose2& pose : action.poses) {
    if (config_.gain == SearchGain::kInformation) {
      gain += emptinessInformation(left.inView(pose, model), model.clutterMean());
    }
    const double detections = left.take(pose, model);
    if (config_.gain == SearchGain::kDetections) gain += detections / action.duration;
  }
  return gain;
}

std::optional<Search::Choice> Search::best(const std::vector<SearchAction>& actions,
                                           const SensorModel& model,
                                           const ExpectedTargets& expected) {
  if (actions.empty()) return std::nullopt;
  if (config_.gain == SearchGain::kRandom) {
    std::uniform_int_distribution<std::size_t> any(0, actions.size() - 1);
    return Choice{actions[any(random_)], 0.0};
  }
  std::optional<Choice> result;
  for (const SearchAction& action : actions) {
    const double gain = gainOf(action, model, expected);
    if (!result || gain > result->gain) result = Choice{action, gain};
  }
  return result;
}

std::vector<std::optional<Search::Choice>> Search::plan(const std::vector<Robot>& robots) {
  for (const Robot& robot : robots) coverReach(robot);
  ExpectedTargets expected(undetected_.grid());
  if (config_.gain == SearchGain::kInformation) {
    for (const Target& target : targets_) expected.add(target.mean, target.probability);
  }
  std::vector<std::optional<Choice>> choices;
  for (const Robot& robot : robots) {
    const SensorModel& model = modelOf(robot.name);
    choices.push_back(best(actions_.from(robot.T_map_sensor), model, expected));
    if (!choices.back()) continue;
    for (const geometry::Pose2& pose : choices.back()->action.poses) expected.take(pose, model);
  }
  return choices;
}

}  // namespace sightline::targets
