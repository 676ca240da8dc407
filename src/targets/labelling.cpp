#include "sightline/targets/labelling.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sightline/logs/assignment.h"

namespace sightline::targets {

namespace {

using Pairing = std::vector<std::optional<std::size_t>>;  // measurement of each opportunity

struct LabelPair {
  double error;
  std::size_t opportunity;
  std::size_t measurement;
};

double errorOf(double bearing, const Opportunity& opportunity, const KnownLook& look,
               const LabellingConfig& config) {
  return geometry::wrapAngle(bearing - opportunity.place.bearing -
                             config.biasAt(opportunity.place.bearing) -
                             config.lag * look.turn_rate);
}

std::vector<LabelPair> pairsWithin(const std::vector<Opportunity>& opportunities,
                                   const KnownLook& look, const LabellingConfig& config) {
  std::vector<LabelPair> pairs;
  for (std::size_t i = 0; i < opportunities.size(); ++i) {
    for (std::size_t m = 0; m < look.bearings.size(); ++m) {
      const double error = errorOf(look.bearings[m], opportunities[i], look, config);
      if (std::abs(error) <= config.gateOf(look)) pairs.push_back({error, i, m});
    }
  }
  return pairs;
}

Pairing nearestFirst(std::vector<LabelPair> pairs, std::size_t opportunities,
                     std::size_t measurements) {
  std::sort(pairs.begin(), pairs.end(), [](const LabelPair& a, const LabelPair& b) {
    return std::abs(a.error) < std::abs(b.error);
  });
  Pairing result(opportunities);
  std::vector<bool> taken(measurements, false);
  for (const LabelPair& pair : pairs) {
    if (result[pair.opportunity] || taken[pair.measurement]) continue;
    result[pair.opportunity] = pair.measurement;
    taken[pair.measurement] = true;
  }
  return result;
}

Pairing bestTogether(const std::vector<LabelPair>& pairs, std::size_t opportunities,
                     std::size_t measurements, double gate) {
  if (pairs.empty()) return Pairing(opportunities);
  // Beyond all squared errors together, so that a pair more is always better.
  const double apart = gate * gate * static_cast<double>(opportunities + 1);
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(opportunities, measurements, apart);
  for (const LabelPair& pair : pairs) {
    cost(static_cast<Eigen::Index>(pair.opportunity), static_cast<Eigen::Index>(pair.measurement)) =
        pair.error * pair.error;
  }
  Pairing result = logs::assign(cost);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const bool is_pair = result[i] && cost(static_cast<Eigen::Index>(i),
                                           static_cast<Eigen::Index>(*result[i])) < apart;
    if (!is_pair) result[i].reset();
  }
  return result;
}

bool isInSight(const KnownLook& look, const Eigen::Vector2d& target_map,
               const LabellingConfig& config) {
  return !config.sight || config.sight->isClear(look.T_map_sensor.translation(), target_map);
}

std::vector<Opportunity> opportunitiesOf(const KnownLook& look, std::size_t index,
                                         const std::vector<Eigen::Vector2d>& targets_map,
                                         const LabellingConfig& config) {
  const geometry::Pose2 T_sensor_map = look.T_map_sensor.inverse();
  std::vector<Opportunity> result;
  for (std::size_t i = 0; i < targets_map.size(); ++i) {
    const Polar place = polarOf(T_sensor_map * targets_map[i]);
    const bool is_in_view = place.range >= config.range_min && place.range <= config.range_max &&
                            config.field_of_view.contains(place.bearing);
    if (is_in_view && isInSight(look, targets_map[i], config))
      result.push_back({index, i, place, false, 0.0});
  }
  return result;
}

bool isMate(double bearing, const KnownLook& look, const LabellingConfig& config) {
  const geometry::Pose2 T_sensor_map = look.T_map_sensor.inverse();
  return std::any_of(
      look.mates_map.begin(), look.mates_map.end(), [&](const Eigen::Vector2d& mate) {
        // A robot is as wide as this at least [m].
        constexpr double kHalfWidth = 0.15;
        const Polar place = polarOf(T_sensor_map * mate);
        const double reach = config.gateOf(look) + kHalfWidth / std::max(place.range, 0.3);
        return std::abs(geometry::wrapAngle(bearing - place.bearing -
                                            config.biasAt(place.bearing))) <= reach;
      });
}

void labelLook(const KnownLook& look, std::size_t index, const LabellingConfig& config,
               std::vector<Opportunity> opportunities, Labels& labels) {
  const auto pairs = pairsWithin(opportunities, look, config);
  const std::size_t count = look.bearings.size();
  const Pairing pairing =
      config.method == LabellingMethod::kNearest
          ? nearestFirst(pairs, opportunities.size(), count)
          : bestTogether(pairs, opportunities.size(), count, config.gateOf(look));
  std::vector<bool> taken(count, false);
  for (std::size_t i = 0; i < pairing.size(); ++i) {
    if (!pairing[i]) continue;
    opportunities[i].is_detected = true;
    opportunities[i].error = errorOf(look.bearings[*pairing[i]], opportunities[i], look, config);
    taken[*pairing[i]] = true;
    ++labels.detected;
  }
  labels.measurements += count;
  labels.opportunities.insert(labels.opportunities.end(), opportunities.begin(),
                              opportunities.end());
  for (std::size_t m = 0; m < count; ++m) {
    if (taken[m]) continue;
    labels.clutter.push_back({index, look.bearings[m], isMate(look.bearings[m], look, config)});
  }
}

}  // namespace

Labels label(const std::vector<KnownLook>& looks, const std::vector<Eigen::Vector2d>& targets_map,
             const LabellingConfig& config) {
  Labels labels;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    labelLook(looks[i], i, config, opportunitiesOf(looks[i], i, targets_map, config), labels);
  }
  return labels;
}

}  // namespace sightline::targets
