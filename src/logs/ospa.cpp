#include "sightline/logs/ospa.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sightline/logs/assignment.h"

namespace sightline::logs {

namespace {

void checkMetric(const SetMetric& metric) {
  if (!(metric.order >= 1.0) || !(metric.cutoff > 0.0) || !std::isfinite(metric.order) ||
      !std::isfinite(metric.cutoff)) {
    throw std::invalid_argument("a metric between sets needs order >= 1 and a cut-off > 0");
  }
}

void checkPoints(const Points& points) {
  for (const Eigen::Vector2d& point : points) {
    if (!point.allFinite()) throw std::invalid_argument("a point of a set is not finite");
  }
}

// Distances cut off, to the power of the order.
Eigen::MatrixXd costsOf(const Points& truth, const Points& estimate, const SetMetric& metric) {
  Eigen::MatrixXd costs(truth.size(), estimate.size());
  for (Eigen::Index i = 0; i < costs.rows(); ++i) {
    for (Eigen::Index j = 0; j < costs.cols(); ++j) {
      const double distance =
          (truth[static_cast<std::size_t>(i)] - estimate[static_cast<std::size_t>(j)]).norm();
      costs(i, j) = std::pow(std::min(metric.cutoff, distance), metric.order);
    }
  }
  return costs;
}

// Costs of the pairs of the best assignment.
std::vector<double> pairCosts(const Points& truth, const Points& estimate,
                              const SetMetric& metric) {
  checkMetric(metric);
  checkPoints(truth);
  checkPoints(estimate);
  std::vector<double> costs;
  if (truth.empty() || estimate.empty()) return costs;
  const Eigen::MatrixXd all = costsOf(truth, estimate, metric);
  const auto partners = assign(all);
  for (std::size_t i = 0; i < partners.size(); ++i) {
    if (!partners[i]) continue;
    costs.push_back(all(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(*partners[i])));
  }
  return costs;
}

}  // namespace

double ospa(const Points& truth, const Points& estimate, const SetMetric& metric) {
  const std::vector<double> costs = pairCosts(truth, estimate, metric);
  const std::size_t most = std::max(truth.size(), estimate.size());
  if (most == 0) return 0.0;
  const double cut = std::pow(metric.cutoff, metric.order);
  double sum = cut * static_cast<double>(most - costs.size());
  for (const double cost : costs) sum += cost;
  return std::pow(sum / static_cast<double>(most), 1.0 / metric.order);
}

Gospa gospa(const Points& truth, const Points& estimate, const SetMetric& metric) {
  // A pair at the cut-off costs as much as a miss and a false estimate: it is counted as these.
  const double cut = std::pow(metric.cutoff, metric.order);
  Gospa result{0.0, 0.0, truth.size(), estimate.size()};
  for (const double cost : pairCosts(truth, estimate, metric)) {
    if (cost >= cut) continue;
    result.localisation += cost;
    --result.missed;
    --result.spurious;
  }
  const double alone = 0.5 * cut * static_cast<double>(result.missed + result.spurious);
  result.value = std::pow(result.localisation + alone, 1.0 / metric.order);
  return result;
}

}  // namespace sightline::logs
