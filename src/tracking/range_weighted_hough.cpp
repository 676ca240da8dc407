#include "sightline/tracking/range_weighted_hough.h"

#include <algorithm>
#include <cmath>

namespace sightline::tracking {

namespace {

double squared(double value) {
  return value * value;
}

// Half the accumulator, in bins; the outermost points of a wide gate may lie beyond its opening.
int halfWidth(const ValidationGate& gate, double bin) {
  return static_cast<int>(std::ceil(gate.size().opening / bin)) + 1;
}

}  // namespace

std::vector<double> RangeWeightedHough::vote(const GatedWall& wall, double turn) const {
  const geometry::PolarLine& predicted = wall.gate.predicted();
  const Eigen::Vector2d normal(std::cos(predicted.phi + turn), std::sin(predicted.phi + turn));
  const int half = halfWidth(wall.gate, config_.distance_bin);
  std::vector<double> accumulator(static_cast<std::size_t>(2 * half + 1), 0.0);
  for (const BeamPoint* point : wall.points) {
    const double bin = (normal.dot(point->position) - predicted.rho) / config_.distance_bin + half;
    const auto lower = static_cast<int>(std::floor(bin));
    if (lower < 0 || lower + 1 > 2 * half) continue;
    // Shared between the two nearest bins, so that a peak on the edge of a bin is not halved.
    const double upper_share = bin - lower;
    accumulator[static_cast<std::size_t>(lower)] += point->range * (1.0 - upper_share);
    accumulator[static_cast<std::size_t>(lower) + 1] += point->range * upper_share;
  }
  return accumulator;
}

std::optional<WallPeak> RangeWeightedHough::bestPeak(const GatedWall& wall, double turn) const {
  if (wall.points.empty()) return std::nullopt;
  const std::vector<double> votes = vote(wall, turn);
  const int half = halfWidth(wall.gate, config_.distance_bin);
  WallPeak best;
  double best_score = 0.0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    const double distance = (static_cast<int>(i) - half) * config_.distance_bin;
    // Between peaks that weigh alike, the prediction decides: half the weight at the edge of the
    // gate.
    const double score = votes[i] * (1.0 - 0.5 * squared(distance / (half * config_.distance_bin)));
    if (score > best_score) {
      best_score = score;
      best = {distance, votes[i]};
    }
  }
  if (best_score <= 0.0) return std::nullopt;
  return best;
}

HoughPeaks RangeWeightedHough::transform(const std::vector<GatedWall>& walls) const {
  double range = 0.0;
  for (const GatedWall& wall : walls) range = std::max(range, wall.gate.size().angle);
  const int half = static_cast<int>(std::ceil(range / config_.angle_bin));
  HoughPeaks best;
  best.walls.resize(walls.size());
  double best_score = 0.0;
  for (int i = -half; i <= half; ++i) {
    HoughPeaks candidate;
    candidate.turn = i * config_.angle_bin;
    double weight = 0.0;
    for (const GatedWall& wall : walls) {
      candidate.walls.push_back(bestPeak(wall, candidate.turn));
      if (candidate.walls.back()) weight += candidate.walls.back()->weight;
    }
    const double score = weight * (1.0 - 0.2 * squared(static_cast<double>(i) / (half + 1)));
    if (score > best_score) {
      best_score = score;
      best = std::move(candidate);
    }
  }
  return best;
}

}  // namespace sightline::tracking
