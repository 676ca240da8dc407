#include "sightline/logs/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <fmt/format.h>

namespace sightline::logs {

namespace {

using geometry::between;
using geometry::Pose2;

constexpr std::int64_t kTolerance = 2'000'000;           // of the stamp of a relation [ns]
constexpr std::int64_t kShortTerm = 5'000'000'000;       // [ns]
constexpr std::int64_t kWidestTruthGap = 1'000'000'000;  // [ns]
constexpr double kBadTranslation = 0.1;                  // [m]
constexpr double kBadRotation = 3.0;                     // [deg]

struct Errors {
  std::vector<double> translation;  // [m]
  std::vector<double> rotation;     // [deg]

  void add(const Pose2& truth, const Pose2& estimate) {
    const Pose2 error = between(truth, estimate);
    translation.push_back(error.translation().norm());
    rotation.push_back(geometry::degrees(std::abs(error.theta())));
  }

  std::optional<PoseErrors> statistics() const {
    if (translation.empty()) return std::nullopt;
    return PoseErrors{statisticsOf(translation), statisticsOf(rotation)};
  }

  double badPercentage() const {
    std::size_t bad = 0;
    for (std::size_t i = 0; i < translation.size(); ++i) {
      if (translation[i] > kBadTranslation || rotation[i] > kBadRotation) ++bad;
    }
    return 100.0 * static_cast<double>(bad) / static_cast<double>(translation.size());
  }
};

// The pose nearest in time, the earlier of two that are as near; null where none is within the
// tolerance.
const geometry::StampedPose2* nearest(const Trajectory& trajectory, std::int64_t stamp) {
  const auto after = geometry::firstFrom(trajectory.begin(), trajectory.end(), stamp);
  const geometry::StampedPose2* found = after == trajectory.end() ? nullptr : &*after;
  if (after != trajectory.begin()) {
    const geometry::StampedPose2& before = *std::prev(after);
    if (!found || stamp - before.stamp <= found->stamp - stamp) found = &before;
  }
  return found && std::abs(found->stamp - stamp) <= kTolerance ? found : nullptr;
}

std::optional<Pose2> truthAt(const Trajectory& truth, std::int64_t stamp) {
  return geometry::poseAt(truth.begin(), truth.end(), stamp, kWidestTruthGap);
}

std::string figures(const Statistics& statistics, const std::string& name, const char* unit) {
  return fmt::format(
      "{0}.mean {1:.4f} {5}\n{0}.std {2:.4f} {5}\n{0}.median {3:.4f} {5}\n{0}.max {4:.4f} {5}\n",
      name, statistics.mean, statistics.std, statistics.median, statistics.max, unit);
}

std::string figures(const PoseErrors& errors, const std::string& name) {
  return figures(errors.translation, name + ".translation", "m") +
         figures(errors.rotation, name + ".rotation", "deg");
}

}  // namespace

Statistics statisticsOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const std::size_t middle = values.size() / 2;
  const double median =
      values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {mean, std::sqrt(squares / count), median, values.back()};
}

RelationErrors compareWithRelations(const Trajectory& trajectory,
                                    const std::vector<Relation>& relations,
                                    const Pose2& T_body_measured) {
  Errors all;
  Errors short_term;
  for (const Relation& relation : relations) {
    const geometry::StampedPose2* first = nearest(trajectory, relation.first);
    const geometry::StampedPose2* second = nearest(trajectory, relation.second);
    if (!first || !second || first == second) continue;
    const Pose2 motion = between(first->pose * T_body_measured, second->pose * T_body_measured);
    all.add(relation.motion, motion);
    const bool is_short = std::abs(relation.second - relation.first) <= kShortTerm;
    if (is_short) short_term.add(relation.motion, motion);
  }
  RelationErrors errors;
  errors.used = all.translation.size();
  errors.total = relations.size();
  errors.all = all.statistics();
  errors.short_term = short_term.statistics();
  if (errors.short_term) errors.bad = short_term.badPercentage();
  return errors;
}

TruthErrors compareWithTruth(const Trajectory& trajectory, const Trajectory& truth,
                             const Pose2& T_body_measured) {
  Errors errors;
  for (const geometry::StampedPose2& timed : trajectory) {
    const auto true_pose = truthAt(truth, timed.stamp);
    if (true_pose) errors.add(*true_pose, timed.pose * T_body_measured);
  }
  return {errors.translation.size(), trajectory.size(), errors.statistics()};
}

std::string figures(const RelationErrors& errors, const std::string& prefix) {
  std::string text = fmt::format("{}relations.used {} of {}\n", prefix, errors.used, errors.total);
  if (errors.short_term) {
    text += figures(*errors.short_term, prefix + "short");
    text += fmt::format("{}short.bad {:.2f} %\n", prefix, errors.bad);
  }
  if (errors.all) text += figures(*errors.all, prefix + "all");
  return text;
}

std::string figures(const TruthErrors& errors, const std::string& prefix) {
  std::string text = fmt::format("{}truth.used {} of {}\n", prefix, errors.used, errors.total);
  if (errors.absolute) text += figures(*errors.absolute, prefix + "absolute");
  return text;
}

}  // namespace sightline::logs
