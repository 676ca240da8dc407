#include "sightline/targets/characterization.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "sightline/config/error.h"
#include "sightline/targets/place_fit.h"

namespace sightline::targets {

namespace {

std::vector<double> edgesOf(double from, double to, int bins) {
  std::vector<double> edges;
  for (int i = 0; i <= bins; ++i) edges.push_back(from + (to - from) * i / bins);
  return edges;
}

// Counts of a table, with those of rows and columns.
struct TableCounts {
  Eigen::MatrixXd tried;
  Eigen::MatrixXd detected;
};

TableCounts countsOf(const std::vector<Opportunity>& opportunities, const DetectionTable& table) {
  const auto rows = static_cast<Eigen::Index>(table.range_edges.size()) - 1;
  const auto columns = static_cast<Eigen::Index>(table.bearing_edges.size()) - 1;
  TableCounts counts{Eigen::MatrixXd::Zero(rows, columns), Eigen::MatrixXd::Zero(rows, columns)};
  const double range_step = table.range_edges[1] - table.range_edges[0];
  const double bearing_step = table.bearing_edges[1] - table.bearing_edges[0];
  for (const Opportunity& one : opportunities) {
    const double row = (one.place.range - table.range_edges[0]) / range_step;
    const double column = (one.place.bearing - table.bearing_edges[0]) / bearing_step;
    if (row < 0.0 || column < 0.0) continue;
    const auto i = std::min(static_cast<Eigen::Index>(row), rows - 1);
    const auto j = std::min(static_cast<Eigen::Index>(column), columns - 1);
    counts.tried(i, j) += 1.0;
    counts.detected(i, j) += one.is_detected ? 1.0 : 0.0;
  }
  return counts;
}

// A bin is drawn to the product of what its range and its bearing say, by `pseudo` looks.
std::vector<double> shrunk(const TableCounts& counts, double pseudo) {
  const double all = std::max(counts.tried.sum(), 1.0);
  const double mean = std::max(counts.detected.sum() / all, 1e-6);
  const auto margin = [&](double detected, double tried) {
    return (detected + pseudo * mean) / (tried + pseudo);
  };
  std::vector<double> probabilities;
  for (Eigen::Index i = 0; i < counts.tried.rows(); ++i) {
    for (Eigen::Index j = 0; j < counts.tried.cols(); ++j) {
      const double by_row = margin(counts.detected.row(i).sum(), counts.tried.row(i).sum());
      const double by_column = margin(counts.detected.col(j).sum(), counts.tried.col(j).sum());
      const double expected = std::min(by_row * by_column / mean, 1.0);
      const double value =
          (counts.detected(i, j) + pseudo * expected) / (counts.tried(i, j) + pseudo);
      probabilities.push_back(std::clamp(value, 0.0, 0.999));
    }
  }
  return probabilities;
}

double quantileOf(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = std::min(static_cast<std::size_t>(share * static_cast<double>(values.size())),
                           values.size() - 1);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

// Looks that a filter will use: their robot has moved since the last one.
std::vector<KnownLook> spaced(const std::vector<KnownLook>& looks,
                              const LookSpacingConfig& spacing) {
  std::vector<KnownLook> result;
  for (const KnownLook& look : looks) {
    if (!result.empty()) {
      const auto moved = geometry::between(result.back().T_map_sensor, look.T_map_sensor);
      const double passed = 1e-9 * static_cast<double>(look.stamp - result.back().stamp);
      const bool is_new = moved.translation().norm() >= spacing.distance ||
                          std::abs(moved.theta()) >= spacing.turn || passed >= spacing.rest;
      if (!is_new) continue;
    }
    result.push_back(look);
  }
  return result;
}

std::vector<KnownLook> looksOf(const std::vector<KnownLook>& looks, std::size_t robot) {
  std::vector<KnownLook> result;
  std::copy_if(looks.begin(), looks.end(), std::back_inserter(result),
               [&](const KnownLook& look) { return look.robot == robot; });
  return result;
}

LabellingConfig labellingOf(const CharacterizationConfig& config,
                            std::shared_ptr<const LineOfSight> sight) {
  LabellingConfig labelling;
  labelling.sight = std::move(sight);
  labelling.field_of_view = config.field_of_view;
  labelling.range_max = config.range_max;
  labelling.sigma = config.sigma;
  return labelling;
}

void addDetections(const Labels& labels, const CharacterizationConfig& config,
                   RobotCharacter& character) {
  std::vector<double> bearings;
  std::vector<double> ranges;
  for (const Opportunity& one : labels.opportunities) {
    if (!one.is_detected) continue;
    bearings.push_back(one.place.bearing);
    ranges.push_back(one.place.range);
  }
  constexpr double kRare = 0.001;
  character.view = {quantileOf(bearings, kRare), quantileOf(bearings, 1.0 - kRare)};
  character.nearest = quantileOf(ranges, kRare);
  character.table.range_edges = edgesOf(0.0, config.range_max, config.range_bins);
  character.table.bearing_edges =
      edgesOf(config.field_of_view.min, config.field_of_view.max, config.bearing_bins);
  character.table.probabilities =
      shrunk(countsOf(labels.opportunities, character.table), config.pseudo_looks);
}

void addCorrelation(const std::vector<KnownLook>& looks, const Labels& labels,
                    RobotCharacter& character) {
  constexpr double kStep = 0.5;
  constexpr double kMost = 30.0;
  constexpr double kNearlyNone = 0.1;
  character.correlations =
      correlationOf(predictionsOf(looks, labels.opportunities, character.table), kStep, kMost);
  character.independent_after = independentAfter(character.correlations, kNearlyNone);
  const auto count = static_cast<double>(std::max<std::size_t>(labels.opportunities.size(), 1));
  double sum = 0.0;
  for (const LagCorrelation& one : character.correlations) {
    sum += std::max(one.correlation, 0.0) * one.pairs / count;
  }
  character.inflation = 1.0 + 2.0 * sum;
}

RobotCharacter characterOf(const std::vector<KnownLook>& looks,
                           const std::vector<Eigen::Vector2d>& targets_map,
                           const CharacterizationConfig& config, LabellingConfig labelling,
                           PlaceFit& places) {
  RobotCharacter character;
  character.errors = fitErrors(looks, targets_map, labelling);
  const Labels labels = label(looks, targets_map, labelling);
  character.looks = looks.size();
  character.opportunities = labels.opportunities.size();
  character.detected = labels.detected;
  for (const ClutterBearing& one : labels.clutter) character.at_mates += one.is_mate ? 1 : 0;
  const auto clutter = static_cast<double>(labels.clutter.size() - character.at_mates);
  character.clutter_mean = clutter / static_cast<double>(std::max<std::size_t>(looks.size(), 1));
  addDetections(labels, config, character);
  addCorrelation(looks, labels, character);
  const std::vector<KnownLook> apart = spaced(looks, config.spacing);
  const Labels of_apart = label(apart, targets_map, labelling);
  character.visibility =
      fitVisibility(predictionsOf(apart, of_apart.opportunities, character.table));
  // The errors of these labels are those that bias, lag and distortion leave.
  ErrorFit left = character.errors;
  left.bias = left.lag = 0.0;
  left.distortion.reset();
  character.error_inflation = inflationOf(apart, of_apart.opportunities, left);
  // All looks: those that a filter uses are too few and too much of turns to tell times.
  character.shared = fitSharedErrors(looks, labels.opportunities, left);
  places.add({apart, labelling, left, character.error_inflation});
  return character;
}

void followThePaper(const std::vector<KnownLook>& looks,
                    const std::vector<Eigen::Vector2d>& targets_map,
                    const CharacterizationConfig& config, LabellingConfig labelling,
                    Characterization& result) {
  labelling.method = LabellingMethod::kNearest;
  result.paper_labels = label(looks, targets_map, labelling);
  result.bins = binByRange(result.paper_labels.opportunities);
  result.paper_detection = fitDetection(result.bins, config.beam_spacing);
  result.clutter_bins = binClutter(result.paper_labels.clutter, config.field_of_view);
  result.paper_clutter = fitClutter(result.clutter_bins, config.field_of_view);
  std::vector<double> sigmas;
  for (double degrees = 0.25; degrees <= 5.0; degrees += 0.25) {
    sigmas.push_back(geometry::radians(degrees));
  }
  result.sweep = sweepSigma(looks, targets_map, labelling, config.beam_spacing, sigmas);
  std::vector<int> of_look(looks.size(), 0);
  for (const ClutterBearing& one : result.paper_labels.clutter) ++of_look[one.look];
  for (const int count : of_look) {
    if (count >= static_cast<int>(result.clutter_counts.size())) {
      result.clutter_counts.resize(static_cast<std::size_t>(count) + 1, 0);
    }
    ++result.clutter_counts[static_cast<std::size_t>(count)];
  }
}

}  // namespace

void CharacterizationConfig::visit(config::FieldVisitor& visitor) {
  visitor.group("field_of_view", field_of_view);
  visitor.number("range_max", range_max, {"m", {0.1, 1e4}, "farther targets are left out"});
  visitor.number("beam_spacing", beam_spacing,
                 {"rad", {1e-6, 1.0}, "angle between two beams, theta_sep (dames eq. 1)"});
  visitor.number(
      "sigma", sigma,
      {"rad", {1e-4, 0.5}, "standard deviation by which bearings are labelled at first"});
  visitor.integer("range_bins", range_bins, {"-", {1, 100}, "of the table of probabilities"});
  visitor.integer("bearing_bins", bearing_bins, {"-", {1, 100}, "of the table of probabilities"});
  visitor.number(
      "pseudo_looks", pseudo_looks,
      {"-", {0.0, 1e6}, "looks by which a bin is drawn to what its range and its bearing say"});
  visitor.group("spacing", spacing);
}

std::vector<Prediction> predictionsOf(const std::vector<KnownLook>& looks,
                                      const std::vector<Opportunity>& opportunities,
                                      const DetectionTable& table) {
  std::vector<Prediction> predictions;
  for (const Opportunity& one : opportunities) {
    const double probability =
        std::clamp(table.at(one.place.range, one.place.bearing), 1e-4, 0.999);
    predictions.push_back({one.target, looks[one.look].stamp, probability, one.is_detected});
  }
  return predictions;
}

SensorModelConfig RobotCharacter::model() const {
  SensorModelConfig model;
  model.field_of_view = {table.bearing_edges.front(), table.bearing_edges.back()};
  model.detection.range_max = table.range_edges.back();
  model.detection.table = table;
  model.visibility = visibility;
  model.bearing.sigma = std::max(errors.sigma, 1e-4);
  model.bearing.bias = errors.bias;
  model.bearing.distortion = errors.distortion;
  model.bearing.lag = std::clamp(errors.lag, -10.0, 10.0);
  model.bearing.jitter = std::min(errors.jitter, 10.0);
  model.bearing.tail = std::min(errors.tail, 10.0);
  model.bearing.common_share = shared.common_share;
  model.bearing.lasting_share = shared.lasting_share;
  model.bearing.lasting_duration = shared.lasting_duration;
  model.bearing.place_sigma = std::min(place_sigma, 10.0);
  model.clutter = {clutter_mean, 1.0, 0.0};
  return model;
}

SensorModelsConfig Characterization::models() const {
  SensorModelsConfig models;
  if (robots.empty()) return models;
  models.common = teamCharacter(robots).model();
  for (const auto& [name, character] : robots) models.robots[name] = character.model();
  return models;
}

Characterization characterize(const std::vector<KnownLook>& looks,
                              const std::vector<std::string>& names,
                              const std::vector<Eigen::Vector2d>& targets_map,
                              const CharacterizationConfig& config,
                              std::shared_ptr<const LineOfSight> sight) {
  constexpr std::size_t kFewest = 100;
  config::validate(config);
  if (targets_map.empty()) throw config::Error("", 0, "targets", "none are known");
  if (looks.size() < kFewest) {
    throw config::Error(
        "", 0, "looks",
        fmt::format("{} with a pose, at least {} are needed", looks.size(), kFewest));
  }
  Characterization result;
  result.looks = looks.size();
  const LabellingConfig labelling = labellingOf(config, std::move(sight));
  followThePaper(looks, targets_map, config, labelling, result);
  double inflated = 0.0;
  double opportunities = 0.0;
  PlaceFit places(targets_map);
  for (std::size_t robot = 0; robot < names.size(); ++robot) {
    const std::vector<KnownLook> own = looksOf(looks, robot);
    if (own.size() < kFewest) continue;
    const RobotCharacter character = characterOf(own, targets_map, config, labelling, places);
    inflated += character.inflation * static_cast<double>(character.opportunities);
    opportunities += static_cast<double>(character.opportunities);
    result.robots[names[robot]] = character;
  }
  const double place_sigma = places.sigma();
  for (auto& [name, robot] : result.robots) robot.place_sigma = place_sigma;
  const double inflation = opportunities > 0.0 ? inflated / opportunities : 1.0;
  result.detection =
      fitDetectionLikelihood(result.paper_labels.opportunities, config.beam_spacing, inflation);
  result.clutter =
      fitClutterLikelihood(result.paper_labels.clutter, config.field_of_view, looks.size());
  return result;
}

}  // namespace sightline::targets
