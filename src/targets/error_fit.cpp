#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "sightline/targets/likelihood_fit.h"

namespace sightline::targets {

namespace {

// A Gaussian, a wider one of the same mean, and an even background, by expectation maximisation.
struct ErrorMixture {
  static constexpr double kWide = 2.5;  // standard deviation of the wider one, in those of the core

  double sigma;
  double bias = 0.0;
  double core = 0.6;  // shares
  double wide = 0.2;

  static double gaussianAt(double scaled, double sigma) {
    return std::exp(-0.5 * scaled * scaled) / (sigma * std::sqrt(2.0 * geometry::kPi));
  }

  // Probabilities that an error is of the core, and of the wider one.
  std::pair<double, double> belongs(double error, double gate) const {
    const double scaled = (error - bias) / sigma;
    const double of_core = core * gaussianAt(scaled, sigma);
    const double of_wide = wide * gaussianAt(scaled / kWide, kWide * sigma);
    const double sum = of_core + of_wide + (1.0 - core - wide) / (2.0 * gate);
    return {of_core / sum, of_wide / sum};
  }

  void step(const std::vector<double>& errors, double gate) {
    double cores = 0.0;
    double wides = 0.0;
    double weights = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (const double error : errors) {
      const auto [of_core, of_wide] = belongs(error, gate);
      // The wider one's errors, scaled to the core's.
      const double weight = of_core + of_wide / (kWide * kWide);
      cores += of_core;
      wides += of_wide;
      weights += weight;
      sum += weight * error;
      squares += weight * error * error;
    }
    bias = sum / weights;
    sigma = std::sqrt(std::max((squares - weights * bias * bias) / (cores + wides), 1e-10));
    const auto count = static_cast<double>(errors.size());
    core = std::min(cores / count, 1.0 - 1e-6);
    wide = std::min(wides / count, 1.0 - 1e-6 - core);
  }

  // Standard deviation of both Gaussians together over that of the core.
  double tail() const { return std::sqrt((core + kWide * kWide * wide) / (core + wide)); }
};

ErrorMixture mixtureOf(const std::vector<double>& errors, double gate) {
  ErrorMixture mixture{gate / 3.0};
  for (int i = 0; i < 200; ++i) mixture.step(errors, gate);
  return mixture;
}

// What is left of errors when those of a lag are taken away.
std::vector<double> withoutLag(const std::vector<KnownLook>& looks,
                               const std::vector<Opportunity>& labelled, double lag) {
  std::vector<double> errors;
  for (const Opportunity& one : labelled) {
    if (one.is_detected) errors.push_back(one.error - lag * looks[one.look].turn_rate);
  }
  return errors;
}

// Sums of the regression of errors on the turn rate.
struct LagSums {
  double rates = 0.0;
  double products = 0.0;

  void add(double weight, double rate, double error) {
    rates += weight * rate * rate;
    products += weight * rate * error;
  }
};

// Weighs each error by how much of it belongs to the Gaussians once the lag found so far is gone.
LagSums lagSums(const std::vector<KnownLook>& looks, const std::vector<Opportunity>& labelled,
                const ErrorMixture& mixture, double lag, double gate) {
  LagSums sums;
  for (const Opportunity& one : labelled) {
    if (!one.is_detected) continue;
    const double rate = looks[one.look].turn_rate;
    const auto [core, wide] = mixture.belongs(one.error - lag * rate, gate);
    const double kept = core + wide / (ErrorMixture::kWide * ErrorMixture::kWide);
    sums.add(kept, rate, one.error - mixture.bias);
  }
  return sums;
}

}  // namespace

ErrorFit fitErrors(const std::vector<KnownLook>& looks, const std::vector<Opportunity>& labelled,
                   double gate) {
  constexpr std::size_t kFewest = 30;
  constexpr int kRounds = 15;
  ErrorFit result;
  result.used = withoutLag(looks, labelled, 0.0).size();
  if (result.used < kFewest) return result;
  ErrorMixture mixture{gate / 3.0};
  for (int round = 0; round < kRounds; ++round) {
    mixture = mixtureOf(withoutLag(looks, labelled, result.lag), gate);
    const LagSums sums = lagSums(looks, labelled, mixture, result.lag, gate);
    if (sums.rates <= 0.0) break;
    result.lag = sums.products / sums.rates;
    result.lag_sigma = mixture.sigma / std::sqrt(sums.rates);
  }
  result.sigma = mixture.sigma;
  result.bias = mixture.bias;
  result.tail = mixture.tail();
  return result;
}

namespace {

// Errors of each target's detections in their order, in σ, outliers cut.
std::map<std::size_t, std::vector<double>> errorsByTarget(const std::vector<KnownLook>& looks,
                                                          const std::vector<Opportunity>& labelled,
                                                          const ErrorFit& fit) {
  constexpr double kFarthest = 3.0;
  std::map<std::size_t, std::vector<double>> errors;
  for (const Opportunity& one : labelled) {
    if (!one.is_detected) continue;
    const double left = one.error - fit.bias - fit.lag * looks[one.look].turn_rate;
    errors[one.target].push_back(std::clamp(left / (fit.sigma * fit.tail), -kFarthest, kFarthest));
  }
  return errors;
}

double correlationAt(const std::map<std::size_t, std::vector<double>>& errors, std::size_t lag) {
  double products = 0.0;
  double squares = 0.0;
  for (const auto& [target, sequence] : errors) {
    for (std::size_t i = lag; i < sequence.size(); ++i) {
      products += sequence[i] * sequence[i - lag];
      squares += 0.5 * (sequence[i] * sequence[i] + sequence[i - lag] * sequence[i - lag]);
    }
  }
  return squares > 0.0 ? products / squares : 0.0;
}

}  // namespace

double inflationOf(const std::vector<KnownLook>& looks, const std::vector<Opportunity>& labelled,
                   const ErrorFit& fit) {
  constexpr std::size_t kFarthest = 50;
  constexpr double kLost = 0.05;
  if (!(fit.sigma > 0.0)) return 1.0;
  const auto errors = errorsByTarget(looks, labelled, fit);
  double inflation = 1.0;
  for (std::size_t lag = 1; lag <= kFarthest; ++lag) {
    const double correlation = correlationAt(errors, lag);
    if (correlation < kLost) break;
    inflation += 2.0 * correlation;
  }
  return inflation;
}

ErrorFit fitErrors(const std::vector<KnownLook>& looks,
                   const std::vector<Eigen::Vector2d>& targets_map, LabellingConfig& labelling) {
  constexpr int kRounds = 4;
  ErrorFit errors;
  for (int round = 0; round < kRounds; ++round) {
    const Labels labels = label(looks, targets_map, labelling);
    const ErrorFit left = fitErrors(looks, labels.opportunities, labelling.gate * labelling.sigma);
    if (!(left.sigma > 0.0)) break;
    if (round == 0) {
      errors = left;
      labelling.sigma = left.sigma * left.tail;
    } else {
      errors.bias += left.bias;
      errors.lag += left.lag;
      errors.lag_sigma = left.lag_sigma;
    }
    labelling.bias = errors.bias;
    labelling.lag = errors.lag;
  }
  return errors;
}

}  // namespace sightline::targets
