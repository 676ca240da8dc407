#include "sightline/targets/oracle.h"

namespace sightline::targets {

namespace {

constexpr int kRanges = 6;
constexpr double kNearest = 0.3;
constexpr std::size_t kMostComponents = 8;

}  // namespace

void Oracle::start(const Look& look, std::size_t measurement, std::size_t target) {
  Birth birth = birthAlong(look, measurement, even_, kRanges, kNearest);
  if (!birth.mixture.empty()) targets_[target] = std::move(birth.mixture);
}

void Oracle::refine(Mixture& mixture, const Look& look, std::size_t measurement) const {
  for (Component& component : mixture) {
    const BearingPrediction prediction = predictBearing(component, look.pose(), look.sigma());
    const double weight = component.weight * (look.likelihood(measurement, prediction) + 1e-12);
    component = updated(component, prediction,
                        geometry::wrapAngle(look.bearing(measurement) - prediction.polar.bearing));
    component.weight = weight;
  }
  reduce(mixture, 2.0, 1e-4, kMostComponents);
}

void Oracle::update(const BearingSet& set, const SensorModel& model,
                    const std::vector<std::optional<std::size_t>>& origins) {
  const Look look(set, model);
  for (std::size_t m = 0; m < origins.size(); ++m) {
    if (!origins[m]) continue;
    const auto found = targets_.find(*origins[m]);
    if (found == targets_.end()) {
      start(look, m, *origins[m]);
    } else {
      refine(found->second, look, m);
    }
  }
}

std::vector<Eigen::Vector2d> Oracle::estimate() const {
  std::vector<Eigen::Vector2d> places;
  for (const auto& [target, mixture] : targets_) places.push_back(mixture.front().mean);
  return places;
}

}  // namespace sightline::targets
