#include "sightline/logs/step_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sightline/geometry/angle.h"
#include "sightline/geometry/parabola.h"

namespace sightline::logs {

namespace {

constexpr double kWidestOffset = 0.5;  // offset [s]
constexpr double kOffsetStep = 0.005;  // of offsets [s]
constexpr std::size_t kFewSteps = 20;
constexpr double kLeastTurn = 0.005;  // RMS of a step [rad], below which turns do not tell
constexpr std::int64_t kWidestGap = 1'000'000'000;  // of the odometry [ns]
constexpr double kStraight = 0.02;                  // [rad] a step
constexpr double kLeastDriven = 2.0;                // [m]

std::optional<geometry::Pose2> motionOf(const Trajectory& odometry, const ScanStep& step,
                                        double offset) {
  const auto shift = static_cast<std::int64_t>(1e9 * offset);
  const auto at = [&](std::int64_t stamp) {
    return geometry::poseAt(odometry.begin(), odometry.end(), stamp - shift, kWidestGap);
  };
  const auto before = at(step.before);
  const auto now = at(step.now);
  if (!before || !now) return std::nullopt;
  return before->inverse() * *now;
}

// Robust mean square of the differences of turns: a wrong step of scans does not decide.
double costAt(const std::vector<ScanStep>& steps, const Trajectory& odometry, double offset) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const ScanStep& step : steps) {
    const auto wheels = motionOf(odometry, step, offset);
    if (!wheels) continue;
    const double off = geometry::wrapAngle(wheels->theta() - step.motion.theta());
    constexpr double kScale = 0.05;  // [rad]
    sum += kScale * kScale * std::log1p(off * off / (kScale * kScale));
    ++count;
  }
  return count < kFewSteps ? std::numeric_limits<double>::infinity()
                           : sum / static_cast<double>(count);
}

double meanSquareTurn(const std::vector<ScanStep>& steps) {
  double sum = 0.0;
  for (const ScanStep& step : steps) sum += std::pow(step.motion.theta(), 2);
  return sum / static_cast<double>(steps.size());
}

// Offset at the lowest point of the parabola through the least cost and its neighbours.
void findOffset(const std::vector<ScanStep>& steps, const Trajectory& odometry,
                StepComparison& result) {
  const int half = static_cast<int>(kWidestOffset / kOffsetStep);
  std::vector<double> costs;
  for (int i = -half; i <= half; ++i) costs.push_back(costAt(steps, odometry, i * kOffsetStep));
  const auto least = std::min_element(costs.begin(), costs.end());
  if (least == costs.begin() || least == std::prev(costs.end())) return;
  const auto lowest = geometry::lowestPoint(*std::prev(least), *least, *std::next(least));
  if (!lowest) return;
  const double index = static_cast<double>(least - costs.begin()) + lowest->offset;
  // The cost is a mean: of a sum of N, a rise by one residual's variance is one sigma.
  result.offset_sigma =
      kOffsetStep * std::sqrt(2.0 * *least / (lowest->bend * static_cast<double>(steps.size())));
  result.offset = (index - half) * kOffsetStep;
}

std::optional<double> scaleOf(const std::vector<ScanStep>& steps, const Trajectory& odometry,
                              double offset) {
  double by_scans = 0.0;
  double by_wheels = 0.0;
  for (const ScanStep& step : steps) {
    const auto wheels = motionOf(odometry, step, offset);
    if (!wheels || std::abs(step.motion.theta()) > kStraight) continue;
    const Eigen::Vector2d along = wheels->translation();
    by_wheels += along.norm();
    if (along.norm() > 0.0) by_scans += step.motion.translation().dot(along) / along.norm();
  }
  if (by_wheels < kLeastDriven) return std::nullopt;
  return by_scans / by_wheels;
}

}  // namespace

StepComparison compareSteps(const std::vector<ScanStep>& steps, const Trajectory& odometry) {
  StepComparison result;
  if (steps.size() < kFewSteps || odometry.size() < 2) return result;
  if (meanSquareTurn(steps) > kLeastTurn * kLeastTurn) findOffset(steps, odometry, result);
  result.scale = scaleOf(steps, odometry, result.offset.value_or(0.0));
  return result;
}

}  // namespace sightline::logs
