#include "sightline/triangulation/noise_current.h"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/Core>

namespace sightline::triangulation {

namespace {

// Straight line through points about their mean.
struct Regression {
  double slope;
  double slope_sigma;
};

Regression regress(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
  const Eigen::ArrayXd dx = x - x.mean();
  const Eigen::ArrayXd dy = y - y.mean();
  const double slope = (dx * dy).sum() / dx.square().sum();
  const double variance = (dy - slope * dx).square().sum() / static_cast<double>(x.size() - 2);
  return {slope, std::sqrt(variance / dx.square().sum())};
}

// Whether a quantity is given in the first of its two units.
bool isOnly(const config::CsvTable& table, const char* column, const char* other) {
  const auto fail = [&](const char* reason) {
    throw config::Error(table.source(), 0, fmt::format("{}, {}", column, other), reason);
  };
  if (table.has(column) && table.has(other)) fail("both are there; one is needed");
  if (!table.has(column) && !table.has(other)) fail("missing column: one of them is needed");
  return table.has(column);
}

}  // namespace

std::vector<SpreadAtCurrent> readSpreads(const config::CsvTable& table) {
  const bool in_nanoamperes = isOnly(table, "current_nA", "current_A");
  const bool in_micrometres = isOnly(table, "image_sigma_um", "image_sigma_m");
  std::vector<SpreadAtCurrent> spreads;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto row = table.row(i);
    spreads.push_back(
        {(in_nanoamperes ? 1e-9 : 1.0) *
             row.number(in_nanoamperes ? "current_nA" : "current_A", config::kPositive),
         (in_micrometres ? 1e-6 : 1.0) *
             row.number(in_micrometres ? "image_sigma_um" : "image_sigma_m", config::kPositive)});
  }
  return spreads;
}

NoiseCurrentEstimate estimateNoiseCurrent(const std::vector<SpreadAtCurrent>& spreads,
                                          const std::string& source) {
  const auto count = static_cast<Eigen::Index>(spreads.size());
  if (count < 3) {
    throw config::Error(source, 0, "", fmt::format("{} readings; at least 3 are needed", count));
  }
  Eigen::ArrayXd current(count);
  Eigen::ArrayXd sigma(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    current[i] = std::log(spreads[static_cast<std::size_t>(i)].current);
    sigma[i] = std::log(spreads[static_cast<std::size_t>(i)].image_position_sigma);
  }
  if (current.maxCoeff() - current.minCoeff() < 1e-9) {
    throw config::Error(source, 0, "", "all readings have the same current");
  }
  const Eigen::ArrayXd products = current + sigma;
  const double scatter = std::sqrt((products - products.mean()).square().sum() /
                                   static_cast<double>((count - 1) * count));
  const Regression line = regress(current, sigma);
  NoiseCurrentEstimate estimate;
  estimate.product = std::exp(products.mean());
  estimate.product_sigma = estimate.product * scatter;
  estimate.free_slope = line.slope;
  estimate.free_slope_sigma = line.slope_sigma;
  estimate.free_product =
      1e-9 * std::exp(sigma.mean() + line.slope * (std::log(1e-9) - current.mean()));
  return estimate;
}

}  // namespace sightline::triangulation
