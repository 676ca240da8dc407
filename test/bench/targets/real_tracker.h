#pragma once

#include <cstdint>
#include <ctime>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "figures.h"
#include "sightline/logs/ospa.h"
#include "sightline/targets/oracle.h"
#include "sightline/targets/target_tracker.h"
#include "targets/real_sensor.h"

namespace sightline::bench {

/// The tracker without bags or topics around it, and the oracle, on the looks of a real set.
class RealLooks {
 public:
  RealLooks(const std::string& data, const std::string& models)
      : all_(data), models_(targets::SensorModelsConfig::readFile(models)) {
    config_.models = models;
  }

  /// Time that a look which counts takes [us].
  double usPerSet() const {
    targets::TargetTracker tracker(config_);
    double used = 0.0;
    const std::clock_t began = std::clock();
    for (const auto& look : all_.looks()) {
      if (tracker.take(nameOf(look), setOf(look)).outcome == targets::LookOutcome::kUsed) {
        used += 1.0;
      }
    }
    return 1e6 * static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC / used;
  }

  /// Mean OSPA of the oracle over a span of time since the first look [s].
  double oracle(double from, double to) const {
    constexpr double kStep = 10.0;
    targets::Oracle oracle;
    std::map<std::size_t, targets::SensorModel> sensors;
    for (std::size_t robot = 0; robot < all_.names().size(); ++robot) {
      sensors.emplace(robot, targets::SensorModel(models_.robots.at(all_.names()[robot])));
    }
    std::vector<double> ospa;
    double next = from;
    const std::int64_t first = all_.looks().front().known.stamp;
    for (const auto& look : all_.looks()) {
      const double now = 1e-9 * static_cast<double>(look.known.stamp - first);
      for (; next < std::min(now, to); next += kStep) {
        ospa.push_back(logs::ospa(all_.landmarks(), oracle.estimate()));
      }
      oracle.update(setOf(look), sensors.at(look.known.robot), originsOf(look));
    }
    return mean(ospa);
  }

 private:
  std::string nameOf(const IdentifiedLooks::Look& look) const {
    return all_.names()[look.known.robot];
  }

  static targets::BearingSet setOf(const IdentifiedLooks::Look& look) {
    targets::BearingSet set;
    set.robot = look.known.robot;
    set.stamp = look.known.stamp;
    set.T_map_sensor.mean = look.known.T_map_sensor;
    set.turn_rate = look.known.turn_rate;
    set.bearings = look.known.bearings;
    return set;
  }

  std::vector<std::optional<std::size_t>> originsOf(const IdentifiedLooks::Look& look) const {
    std::vector<std::optional<std::size_t>> origins;
    for (const int subject : look.subjects) origins.push_back(all_.landmarkOf(subject));
    return origins;
  }

  IdentifiedLooks all_;
  targets::SensorModelsConfig models_;
  targets::TargetTrackerConfig config_;
};

inline void measureRealTracker(const std::string& data, const std::string& models) {
  const RealLooks looks(data, models);
  fmt::print("# targets.real: oracle {:.3f} m from 60 to 300 s, {:.3f} m from there to the end\n",
             looks.oracle(60.0, 300.0), looks.oracle(300.0, 1e9));
  print("targets.real.us_per_set", looks.usPerSet(), "us");
}

}  // namespace sightline::bench
