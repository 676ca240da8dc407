#include "sightline/targets/visibility_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sightline::targets {

namespace {

using Sequences = std::map<std::size_t, std::vector<Prediction>>;  // by target

Sequences sequencesOf(const std::vector<Prediction>& predictions) {
  Sequences sequences;
  for (const Prediction& one : predictions) sequences[one.target].push_back(one);
  return sequences;
}

double secondsBetween(const Prediction& before, const Prediction& after) {
  return 1e-9 * static_cast<double>(after.stamp - before.stamp);
}

// Sums of products of residuals of pairs so far apart.
struct CorrelationSums {
  double products = 0.0;
  double variances = 0.0;
  double pairs = 0.0;

  void add(const Prediction& a, const Prediction& b) {
    products += ((a.is_detected ? 1.0 : 0.0) - a.probability) *
                ((b.is_detected ? 1.0 : 0.0) - b.probability);
    variances +=
        std::sqrt(a.probability * (1.0 - a.probability) * b.probability * (1.0 - b.probability));
    pairs += 1.0;
  }
};

double sequenceLikelihood(const std::vector<Prediction>& sequence,
                          const VisibilityConfig& visibility) {
  double visible = visibility.share;
  double sum = 0.0;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (i > 0) {
      const double kept =
          std::exp(-secondsBetween(sequence[i - 1], sequence[i]) / visibility.duration);
      visible = visibility.share + (visible - visibility.share) * kept;
    }
    const double seen =
        visible * std::clamp(sequence[i].probability / visibility.share, 1e-6, 1.0 - 1e-6);
    sum += std::log(sequence[i].is_detected ? seen : 1.0 - seen);
    visible = sequence[i].is_detected ? 1.0 : (visible - seen) / (1.0 - seen);
  }
  return sum;
}

}  // namespace

std::vector<LagCorrelation> correlationOf(const std::vector<Prediction>& predictions, double step,
                                          double most) {
  const auto count = static_cast<std::size_t>(std::ceil(most / step));
  std::vector<CorrelationSums> sums(count);
  for (const auto& [target, sequence] : sequencesOf(predictions)) {
    for (std::size_t i = 0; i < sequence.size(); ++i) {
      for (std::size_t j = i + 1; j < sequence.size(); ++j) {
        const double apart = secondsBetween(sequence[i], sequence[j]);
        if (apart >= most) break;
        sums[static_cast<std::size_t>(apart / step)].add(sequence[i], sequence[j]);
      }
    }
  }
  std::vector<LagCorrelation> result;
  for (std::size_t i = 0; i < count; ++i) {
    if (sums[i].variances <= 0.0) continue;
    result.push_back({(static_cast<double>(i) + 0.5) * step, sums[i].products / sums[i].variances,
                      sums[i].pairs});
  }
  return result;
}

double independentAfter(const std::vector<LagCorrelation>& correlations, double limit) {
  double after = 0.0;
  for (const LagCorrelation& one : correlations) {
    if (one.correlation >= limit) after = one.seconds;
  }
  return after;
}

double visibilityLikelihood(const std::vector<Prediction>& predictions,
                            const VisibilityConfig& visibility) {
  double sum = 0.0;
  for (const auto& [target, sequence] : sequencesOf(predictions)) {
    sum += sequenceLikelihood(sequence, visibility);
  }
  return sum;
}

VisibilityConfig fitVisibility(const std::vector<Prediction>& predictions) {
  VisibilityConfig best;
  double most = visibilityLikelihood(predictions, best);
  for (double share = 0.3; share < 0.99; share += 0.05) {
    for (double duration = 0.5; duration < 200.0; duration *= 2.0) {
      const VisibilityConfig tried{share, duration};
      const double value = visibilityLikelihood(predictions, tried);
      // Two parameters more have to pay, or independent looks remain.
      constexpr double kTwoParameters = 6.9;
      if (value <= most + (best.share == 1.0 ? kTwoParameters : 0.0)) continue;
      most = value;
      best = tried;
    }
  }
  return best;
}

}  // namespace sightline::targets
