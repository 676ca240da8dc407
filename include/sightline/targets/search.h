#pragma once

#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "sightline/targets/action_set.h"
#include "sightline/targets/target_filter.h"
#include "sightline/targets/target_tracker_config.h"
#include "sightline/targets/undetected.h"

namespace sightline::targets {

/// Measure by which a robot chooses its way.
enum class SearchGain {
  kDetections,   ///< expected number of targets that are seen for the first time, a second
  kInformation,  ///< the law of the paper's search: information that empty looks and others bring
  kRandom,       ///< any way, as in the paper's experiment
};

/// Settings of Search.
struct SearchConfig {
  SearchGain gain = SearchGain::kDetections;
  ActionSetConfig actions;
  UndetectedConfig undetected;
  double replan = 3.0;  ///< time after which kDetections chooses anew; 0: at the ends of ways [s]
  int seed = 1;         ///< of random ways

  void visit(config::FieldVisitor& visitor);
};

/// Expected number of targets in each cell of a grid, less those that planned looks will see.
class ExpectedTargets {
 public:
  explicit ExpectedTargets(const IntensityGrid& grid);

  void add(const Eigen::Vector2d& place_map, double mass);
  /// Expected number that a look from a pose detects, who are taken away.
  double take(const geometry::Pose2& T_map_sensor, const SensorModel& model);
  /// Expected number in view of a pose, and of those that a look detects.
  struct InView {
    double all = 0.0;
    double detected = 0.0;
  };
  InView inView(const geometry::Pose2& T_map_sensor, const SensorModel& model) const;

 private:
  template <class Visit>
  void visitInView(const geometry::Pose2& T_map_sensor, const SensorModel& model,
                   const Visit& visit) const;

  const IntensityGrid* grid_;
  std::vector<double> numbers_;
};

/// Information [nats] in whether a look is empty about a Poisson number of targets in view, each
/// detected with the same probability, among clutter of a mean: the binary sensor of the paper's
/// control law.
double emptinessInformation(const ExpectedTargets::InView& view, double clutter_mean);

/// Chooses where each robot of a team looks for targets next: the way of most gain, one robot after
/// the other, each knowing what those before it will have seen. Keeps its own account of where
/// nobody has looked yet. Not thread-safe.
class Search {
 public:
  /// Models of the robots' sensors by name; walls by `sight`, none: there are none. Throws
  /// config::Error.
  Search(const SearchConfig& config, const SensorModelsConfig& models,
         std::shared_ptr<const LineOfSight> sight = nullptr);

  /// Takes note of a look, whatever it saw.
  void look(const std::string& robot, const BearingSet& set);
  /// Targets that are known by now, for SearchGain::kInformation.
  void setTargets(std::vector<Target> targets) { targets_ = std::move(targets); }

  struct Robot {
    std::string name;
    geometry::Pose2 T_map_sensor;
  };
  struct Choice {
    SearchAction action;
    double gain = 0.0;  ///< [1/s] or [nats]; of a random way 0
  };
  /// A way for each robot; nothing for one that cannot go anywhere.
  std::vector<std::optional<Choice>> plan(const std::vector<Robot>& robots);
  /// Targets that are yet to be found where robots have looked or been near.
  double expectedUndetected() const { return undetected_.mass(); }
  const IntensityGrid& undetected() const { return undetected_.grid(); }
  void reset();

 private:
  const SensorModel& modelOf(const std::string& robot);
  void coverReach(const Robot& robot);
  double gainOf(const SearchAction& action, const SensorModel& model,
                const ExpectedTargets& expected) const;
  std::optional<Choice> best(const std::vector<SearchAction>& actions, const SensorModel& model,
                             const ExpectedTargets& expected);

  SearchConfig config_;
  SensorModelsConfig models_config_;
  std::shared_ptr<const LineOfSight> sight_;
  ActionSet actions_;
  Undetected undetected_;
  std::map<std::string, SensorModel> models_;
  std::vector<Target> targets_;
  std::mt19937_64 random_;
};

}  // namespace sightline::targets
