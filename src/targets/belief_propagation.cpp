#include "sightline/targets/belief_propagation.h"

namespace sightline::targets {

namespace {

constexpr int kMostIterations = 200;
constexpr double kPrecision = 1e-5;

// Messages from targets to measurements, by those from measurements to targets.
Eigen::MatrixXd fromTargets(const Eigen::MatrixXd& ratio, const Eigen::MatrixXd& to_targets) {
  const Eigen::ArrayXXd weighted = ratio.array() * to_targets.array();
  const Eigen::ArrayXd others = 1.0 + weighted.rowwise().sum();
  return ratio.array() / ((-weighted).colwise() + others);
}

Eigen::MatrixXd fromMeasurements(const Eigen::MatrixXd& to_measurements) {
  const Eigen::ArrayXXd messages = to_measurements.array();
  const Eigen::Array<double, 1, Eigen::Dynamic> others = 1.0 + messages.colwise().sum();
  return 1.0 / ((-messages).rowwise() + others);
}

}  // namespace

Association associate(const Eigen::MatrixXd& ratio) {
  Eigen::MatrixXd to_targets = Eigen::MatrixXd::Ones(ratio.rows(), ratio.cols());
  Eigen::MatrixXd to_measurements = Eigen::MatrixXd::Zero(ratio.rows(), ratio.cols());
  for (int i = 0; i < kMostIterations && ratio.size() > 0; ++i) {
    to_measurements = fromTargets(ratio, to_targets);
    const Eigen::MatrixXd next = fromMeasurements(to_measurements);
    const double change = (next - to_targets).cwiseAbs().maxCoeff();
    to_targets = next;
    if (change < kPrecision) break;
  }
  Association result;
  const Eigen::ArrayXXd weighted = ratio.array() * to_targets.array();
  const Eigen::ArrayXd sums = 1.0 + weighted.rowwise().sum();
  result.assigned = weighted.colwise() / sums;
  result.unassigned = (1.0 / (1.0 + to_measurements.array().colwise().sum())).matrix().transpose();
  return result;
}

}  // namespace sightline::targets
