#include "sightline/tracking/range_weighted_hough.h"

#include <algorithm>
#include <cmath>

namespace sightline::tracking {

namespace {

constexpr struct {
  // Most bins on either side of the prediction. The defaults need 26 and 41.
  int most_bins = 100;
  // Chosen, not measured: share of its weight that a peak loses at the edge of a gate, by distance
  // and by turn.
  double distance_penalty = 0.5;
  double turn_penalty = 0.2;
  std::size_t most_peaks = 3;  // of one wall
  double least_share = 0.2;    // of the heaviest peak's weight
} kHough;

double squared(double value) {
  return value * value;
}

// One dimension of the accumulator: bins on both sides of the prediction.
struct Axis {
  double bin;  // width
  int half;    // bins on either side

  Axis(double reach, double wanted_bin)
      : bin(std::max(wanted_bin, reach / kHough.most_bins)),
        half(static_cast<int>(std::ceil(reach / bin))) {}
  double at(int i) const { return i * bin; }
};

// The outermost points of a wide gate may lie beyond its opening: one more bin.
Axis distancesOf(const GatedWall& wall, const HoughConfig& config) {
  Axis axis(wall.gate.size().opening, config.distance_bin);
  ++axis.half;
  return axis;
}

std::vector<double> vote(const GatedWall& wall, double turn, const Axis& axis) {
  const geometry::PolarLine& predicted = wall.gate.predicted();
  const Eigen::Vector2d normal(std::cos(predicted.phi + turn), std::sin(predicted.phi + turn));
  std::vector<double> accumulator(static_cast<std::size_t>(2 * axis.half + 1), 0.0);
  for (const BeamPoint* point : wall.points) {
    const double bin = (normal.dot(point->position) - predicted.rho) / axis.bin + axis.half;
    const double floor = std::floor(bin);
    if (!(floor >= 0.0 && floor + 1.0 <= 2.0 * axis.half)) continue;
    const auto lower = static_cast<std::size_t>(floor);
    // Shared between the two nearest bins, so that a peak on the edge of a bin is not halved.
    const double upper_share = bin - floor;
    accumulator[lower] += point->range * (1.0 - upper_share);
    accumulator[lower + 1] += point->range * upper_share;
  }
  return accumulator;
}

// The heaviest bin at a turn, where weights fall by `penalty` towards the edge of the gate.
std::optional<WallPeak> bestPeak(const GatedWall& wall, double turn, const HoughConfig& config,
                                 double penalty) {
  if (wall.points.empty()) return std::nullopt;
  const Axis axis = distancesOf(wall, config);
  const std::vector<double> votes = vote(wall, turn, axis);
  std::optional<WallPeak> best;
  double best_score = 0.0;
  for (int i = -axis.half; i <= axis.half; ++i) {
    const double weight = votes[static_cast<std::size_t>(i + axis.half)];
    const double score = weight * (1.0 - penalty * squared(static_cast<double>(i) / axis.half));
    if (score <= best_score) continue;
    best_score = score;
    best = WallPeak{turn, axis.at(i), weight, config.angle_bin, axis.bin};
  }
  return best;
}

// The peaks of a wall at a turn, by weight, those at the edge of the gate less.
std::vector<WallPeak> peaksAt(const GatedWall& wall, double turn, const HoughConfig& config) {
  std::vector<WallPeak> peaks;
  if (wall.points.empty()) return peaks;
  const Axis axis = distancesOf(wall, config);
  std::vector<double> scores = vote(wall, turn, axis);
  const std::vector<double> votes = scores;
  for (int i = -axis.half; i <= axis.half; ++i) {
    scores[static_cast<std::size_t>(i + axis.half)] *=
        1.0 - kHough.distance_penalty * squared(static_cast<double>(i) / axis.half);
  }
  double least = 0.0;
  while (peaks.size() < kHough.most_peaks) {
    const auto best = std::max_element(scores.begin(), scores.end());
    if (*best <= least) break;
    least = std::max(least, kHough.least_share * *best);
    const auto at = static_cast<int>(best - scores.begin());
    peaks.push_back({turn, axis.at(at - axis.half), votes[static_cast<std::size_t>(at)],
                     config.angle_bin, axis.bin});
    const auto from = scores.begin() + std::max(0, at - kBinsApart + 1);
    const auto to = scores.begin() + std::min(2 * axis.half + 1, at + kBinsApart);
    std::fill(from, to, 0.0);
  }
  return peaks;
}

}  // namespace

HoughPeaks RangeWeightedHough::transform(const std::vector<GatedWall>& walls) const {
  double reach = 0.0;
  for (const GatedWall& wall : walls) reach = std::max(reach, wall.gate.size().angle);
  const Axis turns(reach, config_.angle_bin);
  HoughPeaks best;
  double best_score = 0.0;
  for (int i = -turns.half; i <= turns.half; ++i) {
    double weight = 0.0;
    for (const GatedWall& wall : walls) {
      const auto peak = bestPeak(wall, turns.at(i), config_, kHough.distance_penalty);
      if (peak) weight += peak->weight;
    }
    const double off = static_cast<double>(i) / (turns.half + 1);
    const double score = weight * (1.0 - kHough.turn_penalty * squared(off));
    if (score <= best_score) continue;
    best_score = score;
    best.turn = turns.at(i);
  }
  for (const GatedWall& wall : walls) {
    best.walls.push_back(peaksAt(wall, best.turn, config_));
    for (WallPeak& peak : best.walls.back()) peak.turn_bin = turns.bin;
  }
  return best;
}

std::optional<WallPeak> RangeWeightedHough::heaviest(const GatedWall& wall) const {
  const Axis turns(wall.gate.size().angle, config_.angle_bin);
  std::optional<WallPeak> best;
  for (int i = -turns.half; i <= turns.half; ++i) {
    const auto peak = bestPeak(wall, turns.at(i), config_, 0.0);
    if (!peak || (best && peak->weight <= best->weight)) continue;
    best = peak;
    best->turn_bin = turns.bin;
  }
  return best;
}

geometry::PolarLine lineAt(const WallPeak& peak, const geometry::PolarLine& predicted) {
  geometry::PolarLine line = predicted;
  line.rho += peak.distance;
  line.phi += peak.turn;
  line.covariance =
      Eigen::Vector2d(squared(peak.distance_bin), squared(peak.turn_bin)).asDiagonal();
  return geometry::canonical(line);
}

}  // namespace sightline::tracking
