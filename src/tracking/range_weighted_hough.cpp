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

// The beams of a wall, and their votes at one turn after another.
class Ballot {
 public:
  Ballot(const GatedWall& wall, const HoughConfig& config, double penalty)
      : predicted_(wall.gate.predicted()), axis_(distancesOf(wall, config)), config_(config) {
    for (const BeamPoint* point : wall.points) {
      x_.push_back(point->position.x());
      y_.push_back(point->position.y());
      ranges_.push_back(point->range);
    }
    places_.resize(ranges_.size());
    for (int i = -axis_.half; i <= axis_.half; ++i) {
      shares_.push_back(1.0 - penalty * squared(static_cast<double>(i) / axis_.half));
    }
  }

  bool isEmpty() const { return ranges_.empty(); }
  const Axis& axis() const { return axis_; }

  // Weight of each bin at a turn.
  const std::vector<double>& vote(double turn) {
    findPlaces(turn);
    accumulator_.assign(static_cast<std::size_t>(2 * axis_.half + 1), 0.0);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double place = places_[i];
      if (!(place >= 0.0 && place < 2.0 * axis_.half)) continue;
      const auto lower = static_cast<std::size_t>(place);
      // Shared between the two nearest bins, so that a peak on the edge of a bin is not halved.
      const double upper_share = place - static_cast<double>(lower);
      accumulator_[lower] += ranges_[i] * (1.0 - upper_share);
      accumulator_[lower + 1] += ranges_[i] * upper_share;
    }
    return accumulator_;
  }

  // The bin at a turn that is heaviest by what it keeps of its weight; nothing without votes.
  std::optional<std::size_t> heaviest(double turn) {
    vote(turn);
    std::optional<std::size_t> best;
    double best_score = 0.0;
    for (std::size_t i = 0; i < accumulator_.size(); ++i) {
      const double score = accumulator_[i] * shares_[i];
      if (score <= best_score) continue;
      best_score = score;
      best = i;
    }
    return best;
  }
  double weightOf(std::size_t bin) const { return accumulator_[bin]; }
  double shareOf(std::size_t bin) const { return shares_[bin]; }
  WallPeak peak(double turn, std::size_t bin, double weight) const {
    return {turn, axis_.at(static_cast<int>(bin) - axis_.half), weight, config_.angle_bin,
            axis_.bin};
  }

 private:
  // In bins from the first one.
  void findPlaces(double turn) {
    const double normal_x = std::cos(predicted_.phi + turn);
    const double normal_y = std::sin(predicted_.phi + turn);
    const double rho = predicted_.rho, bin = axis_.bin, half = axis_.half;
    const double* x = x_.data();
    const double* y = y_.data();
    double* places = places_.data();
    const std::size_t count = places_.size();
    for (std::size_t i = 0; i < count; ++i) {
      places[i] = (normal_x * x[i] + normal_y * y[i] - rho) / bin + half;
    }
  }

  geometry::PolarLine predicted_;
  Axis axis_;
  HoughConfig config_;
  std::vector<double> x_, y_, ranges_;  // of the beams
  std::vector<double> places_;          // of their votes
  std::vector<double> shares_;          // of its weight that a bin keeps
  std::vector<double> accumulator_;
};

// The peaks of a wall at a turn, by weight, those at the edge of the gate less.
std::vector<WallPeak> peaksAt(Ballot& ballot, double turn) {
  std::vector<WallPeak> peaks;
  if (ballot.isEmpty()) return peaks;
  std::vector<double> scores = ballot.vote(turn);
  for (std::size_t i = 0; i < scores.size(); ++i) scores[i] *= ballot.shareOf(i);
  double least = 0.0;
  while (peaks.size() < kHough.most_peaks) {
    const auto best = std::max_element(scores.begin(), scores.end());
    if (*best <= least) break;
    least = std::max(least, kHough.least_share * *best);
    const auto at = static_cast<int>(best - scores.begin());
    const auto bin = static_cast<std::size_t>(at);
    peaks.push_back(ballot.peak(turn, bin, ballot.weightOf(bin)));
    const auto from = scores.begin() + std::max(0, at - kBinsApart + 1);
    const auto to = scores.begin() + std::min(static_cast<int>(scores.size()), at + kBinsApart);
    std::fill(from, to, 0.0);
  }
  return peaks;
}

}  // namespace

HoughPeaks RangeWeightedHough::transform(const std::vector<GatedWall>& walls) const {
  double reach = 0.0;
  for (const GatedWall& wall : walls) reach = std::max(reach, wall.gate.size().angle);
  const Axis turns(reach, config_.angle_bin);
  std::vector<Ballot> ballots;
  ballots.reserve(walls.size());
  for (const GatedWall& wall : walls) ballots.emplace_back(wall, config_, kHough.distance_penalty);
  HoughPeaks best;
  double best_score = 0.0;
  for (int i = -turns.half; i <= turns.half; ++i) {
    double weight = 0.0;
    for (Ballot& ballot : ballots) {
      const auto bin = ballot.isEmpty() ? std::nullopt : ballot.heaviest(turns.at(i));
      if (bin) weight += ballot.weightOf(*bin);
    }
    const double off = static_cast<double>(i) / (turns.half + 1);
    const double score = weight * (1.0 - kHough.turn_penalty * squared(off));
    if (score <= best_score) continue;
    best_score = score;
    best.turn = turns.at(i);
  }
  for (Ballot& ballot : ballots) {
    best.walls.push_back(peaksAt(ballot, best.turn));
    for (WallPeak& peak : best.walls.back()) peak.turn_bin = turns.bin;
  }
  return best;
}

std::optional<WallPeak> RangeWeightedHough::heaviest(const GatedWall& wall) const {
  const Axis turns(wall.gate.size().angle, config_.angle_bin);
  Ballot ballot(wall, config_, 0.0);
  std::optional<WallPeak> best;
  if (ballot.isEmpty()) return best;
  for (int i = -turns.half; i <= turns.half; ++i) {
    const auto bin = ballot.heaviest(turns.at(i));
    if (!bin || (best && ballot.weightOf(*bin) <= best->weight)) continue;
    best = ballot.peak(turns.at(i), *bin, ballot.weightOf(*bin));
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
