#pragma once

#include <vector>

#include "sightline/targets/labelling.h"

namespace sightline::targets {

/// Correlation of detections of the same target by the same robot.
struct LagCorrelation {
  double seconds = 0.0;
  double correlation = 0.0;
  double pairs = 0.0;
};

/// Opportunities of one robot with the probability of each, as a model has it.
struct Prediction {
  std::size_t target = 0;
  std::int64_t stamp = 0;
  double probability = 0.0;
  bool is_detected = false;
};

/// Correlation of what is left of detections when the model's probability is taken away, by time
/// between two looks, in steps of `step` [s] up to `most` [s].
std::vector<LagCorrelation> correlationOf(const std::vector<Prediction>& predictions, double step,
                                          double most);
/// The least time from which on the correlation stays below `limit`; the last one where none does.
double independentAfter(const std::vector<LagCorrelation>& correlations, double limit);

/// The two-state model of VisibilityConfig of greatest likelihood: the recursion that the filter
/// uses, over the sequence of each target.
VisibilityConfig fitVisibility(const std::vector<Prediction>& predictions);
double visibilityLikelihood(const std::vector<Prediction>& predictions,
                            const VisibilityConfig& visibility);

}  // namespace sightline::targets
