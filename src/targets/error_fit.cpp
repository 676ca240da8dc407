#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/LU>

#include "sightline/targets/error_mixture.h"
#include "sightline/targets/likelihood_fit.h"

namespace sightline::targets {

namespace {

constexpr int kTerms = 5;  // at most: bias, turn rate, and three powers of the bearing
using Terms = Eigen::Matrix<double, kTerms, 1>;

// An error and what it may depend on.
struct ErrorRow {
  Terms terms;
  double error = 0.0;
  double scale = 1.0;  // of its standard deviation over that of a sensor at rest
};

// Bearings between which nearly all detections lie.
struct Extent {
  double low = 0.0;
  double high = 0.0;

  // In [-1, 1] between them, held there beyond.
  double scaled(double bearing) const {
    const double width = std::max(high - low, 1e-9);
    return std::clamp(2.0 * (bearing - low) / width - 1.0, -1.0, 1.0);
  }
};

Extent extentOf(const std::vector<Opportunity>& labelled) {
  constexpr std::size_t kThousand = 1000;
  std::vector<double> bearings;
  for (const Opportunity& one : labelled) {
    if (one.is_detected) bearings.push_back(one.place.bearing);
  }
  std::sort(bearings.begin(), bearings.end());
  const std::size_t cut = bearings.size() / kThousand;
  return {bearings[cut], bearings[bearings.size() - 1 - cut]};
}

std::vector<ErrorRow> rowsOf(const std::vector<KnownLook>& looks,
                             const std::vector<Opportunity>& labelled, const Extent& extent) {
  std::vector<ErrorRow> rows;
  for (const Opportunity& one : labelled) {
    if (!one.is_detected) continue;
    const double u = extent.scaled(one.place.bearing);
    ErrorRow row;
    row.terms << 1.0, looks[one.look].turn_rate, u, u * u, u * u * u;
    row.error = one.error;
    rows.push_back(row);
  }
  return rows;
}

// Regression of errors on the first `terms` of what they may depend on, each error weighed by how
// much of it belongs to the Gaussians once what was found so far is gone.
struct ErrorRegression {
  Terms slopes = Terms::Zero();
  ErrorMixture mixture;
  double lag_variance = 0.0;
  double log_likelihood = 0.0;

  ErrorRegression(const std::vector<ErrorRow>& rows, int terms, double gate) {
    constexpr int kRounds = 15;
    for (int round = 0; round < kRounds; ++round) {
      mixture = ErrorMixture::of(leftOf(rows), gate);
      solve(rows, terms, gate);
    }
    log_likelihood = mixture.logLikelihood(leftOf(rows), gate);
    for (const ErrorRow& row : rows) log_likelihood -= std::log(row.scale);
  }

  double leftOf(const ErrorRow& row) const {
    return (row.error - slopes.dot(row.terms)) / row.scale;
  }
  std::vector<double> leftOf(const std::vector<ErrorRow>& rows) const {
    std::vector<double> left;
    for (const ErrorRow& row : rows) left.push_back(leftOf(row));
    return left;
  }

 private:
  void solve(const std::vector<ErrorRow>& rows, int terms, double gate) {
    constexpr double kTiny = 1e-9;  // keeps what no error depends on at 0
    Eigen::MatrixXd squares = kTiny * Eigen::MatrixXd::Identity(terms, terms);
    Eigen::VectorXd products = Eigen::VectorXd::Zero(terms);
    for (const ErrorRow& row : rows) {
      const double weight = mixture.weightOf(leftOf(row), gate) / (row.scale * row.scale);
      squares += weight * row.terms.head(terms) * row.terms.head(terms).transpose();
      products += weight * row.error * row.terms.head(terms);
    }
    const Eigen::MatrixXd inverse = squares.inverse();
    slopes.head(terms) = inverse * products;
    lag_variance = squares(1, 1) > 2.0 * kTiny ? std::pow(mixture.sigma, 2) * inverse(1, 1) : 0.0;
  }
};

void scaleBy(double ratio, std::vector<ErrorRow>& rows) {
  for (ErrorRow& row : rows) row.scale = std::hypot(1.0, ratio * row.terms[1]);
}

// Jitter of the stamps over σ [s/rad], by the likelihood of what bias and lag leave; 0 where it
// does not pay. Scales the rows by it.
double scaleByJitter(const ErrorRegression& even, double gate, std::vector<ErrorRow>& rows) {
  double best = 0.0;
  double most = even.log_likelihood + 0.5 * std::log(static_cast<double>(rows.size()));
  for (double ratio = 0.5; ratio < 30.0; ratio *= 1.5) {
    scaleBy(ratio, rows);
    const std::vector<double> left = even.leftOf(rows);
    double value = ErrorMixture::of(left, gate).logLikelihood(left, gate);
    for (const ErrorRow& row : rows) value -= std::log(row.scale);
    if (value <= most) continue;
    most = value;
    best = ratio;
  }
  scaleBy(best, rows);
  return best;
}

ErrorFit fitOf(const ErrorRegression& regression, double jitter_ratio, std::size_t used) {
  ErrorFit fit;
  fit.sigma = regression.mixture.sigma;
  fit.tail = regression.mixture.tail();
  fit.jitter = jitter_ratio * fit.sigma * fit.tail;
  fit.bias = regression.slopes[0];
  fit.lag = regression.slopes[1];
  fit.lag_sigma = std::sqrt(regression.lag_variance);
  fit.used = used;
  return fit;
}

// The curve of the bearing by its values; the bias holds its mean over the detections.
void addDistortion(const ErrorRegression& regression, const std::vector<ErrorRow>& rows,
                   const Extent& extent, ErrorFit& fit) {
  constexpr int kSpans = 12;
  const auto curve = [&](double u) {
    return u * (regression.slopes[2] + u * (regression.slopes[3] + u * regression.slopes[4]));
  };
  double mean = 0.0;
  for (const ErrorRow& row : rows) mean += curve(row.terms[2]) / static_cast<double>(rows.size());
  fit.bias += mean;
  fit.distortion.emplace();
  for (int i = 0; i <= kSpans; ++i) {
    const double bearing = extent.low + (extent.high - extent.low) * i / kSpans;
    fit.distortion->bearings.push_back(bearing);
    fit.distortion->errors.push_back(curve(extent.scaled(bearing)) - mean);
  }
}

}  // namespace

ErrorFit fitErrors(const std::vector<KnownLook>& looks, const std::vector<Opportunity>& labelled,
                   double gate) {
  constexpr std::size_t kFewest = 30;
  ErrorFit result;
  result.used = static_cast<std::size_t>(std::count_if(
      labelled.begin(), labelled.end(), [](const Opportunity& one) { return one.is_detected; }));
  if (result.used < kFewest) return result;
  const Extent extent = extentOf(labelled);
  std::vector<ErrorRow> rows = rowsOf(looks, labelled, extent);
  const double jitter_ratio = scaleByJitter(ErrorRegression(rows, 2, gate), gate, rows);
  const ErrorRegression even(rows, 2, gate);
  result = fitOf(even, jitter_ratio, rows.size());
  const ErrorRegression curved(rows, kTerms, gate);
  // Bayes' criterion; errors that last are fewer than they look.
  const double price = 0.5 * (kTerms - 2) * std::log(static_cast<double>(rows.size()));
  const double gain = curved.log_likelihood - even.log_likelihood;
  if (gain <= price * inflationOf(looks, labelled, result)) return result;
  result = fitOf(curved, jitter_ratio, rows.size());
  addDistortion(curved, rows, extent, result);
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
    const double turn_rate = looks[one.look].turn_rate;
    const double left = one.error - fit.biasAt(one.place.bearing) - fit.lag * turn_rate;
    errors[one.target].push_back(std::clamp(left / fit.sigmaAt(turn_rate), -kFarthest, kFarthest));
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

namespace {

void addTo(std::optional<DistortionConfig>& sum, const std::optional<DistortionConfig>& more) {
  if (!sum || !more) {
    sum = sum ? sum : more;
    return;
  }
  for (std::size_t i = 0; i < sum->bearings.size(); ++i) {
    sum->errors[i] += more->at(sum->bearings[i]);
  }
}

}  // namespace

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
      labelling.jitter = left.jitter;
    } else {
      errors.bias += left.bias;
      addTo(errors.distortion, left.distortion);
      errors.lag += left.lag;
      errors.lag_sigma = left.lag_sigma;
    }
    labelling.bias = errors.bias;
    labelling.distortion = errors.distortion;
    labelling.lag = errors.lag;
  }
  return errors;
}

}  // namespace sightline::targets
