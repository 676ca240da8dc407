#include "sightline/scan/miss_value.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sightline::scan {

namespace {

constexpr struct {
  // Fewest beams that tell.
  std::size_t beams = 5;
  // A range that comes so many times as often as any other is none.
  std::size_t times = 5;
  // Share of the largest range from which on a value may stand for a miss.
  double end = 0.9;
} kMisses;

// A range and the number of beams that ended exactly there.
struct Level {
  double range;
  std::size_t beams;
};

double largestRange(const Scan& scan) {
  double largest = 0.0;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (scan.isValid(i)) largest = std::max(largest, scan.ranges()[i]);
  }
  return largest;
}

// Takes ranges from `least` on, rising.
std::vector<Level> levelsOf(const Scan& scan, double least) {
  std::vector<double> ranges;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (scan.isValid(i) && scan.ranges()[i] >= least) ranges.push_back(scan.ranges()[i]);
  }
  std::sort(ranges.begin(), ranges.end());
  std::vector<Level> levels;
  for (const double range : ranges) {
    if (levels.empty() || levels.back().range != range) levels.push_back({range, 0});
    ++levels.back().beams;
  }
  return levels;
}

bool isRarer(const Level& a, const Level& b) {
  return a.beams < b.beams;
}

// Step in which the scanner counts: infinite where all ranges are equal.
double stepOf(const std::vector<Level>& levels) {
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < levels.size(); ++i) {
    step = std::min(step, levels[i].range - levels[i - 1].range);
  }
  return step;
}

// Beams in a row that end exactly there.
std::size_t longestRun(const Scan& scan, double range) {
  std::size_t longest = 0;
  std::size_t run = 0;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    run = scan.isValid(i) && scan.ranges()[i] == range ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

// About the foot of the perpendicular the ranges to a straight wall grow by r α²/2 to either side:
// over this angle they differ by no more than a step.
double widestWall(double range, double step) {
  return std::isfinite(step) ? 2.0 * std::sqrt(2.0 * step / range) : 0.0;
}

bool isMiss(const Scan& scan, const Level& level) {
  if (level.beams < kMisses.beams) return false;
  const std::vector<Level> levels = levelsOf(scan, 0.0);
  std::size_t most_common = 1;
  for (const Level& other : levels) {
    if (other.range != level.range) most_common = std::max(most_common, other.beams);
  }
  if (level.beams >= kMisses.times * most_common) return true;
  const std::size_t run = longestRun(scan, level.range);
  if (run < kMisses.beams) return false;
  const double angle = std::abs(scan.geometry()->angleIncrement()) * static_cast<double>(run - 1);
  return angle > widestWall(level.range, stepOf(levels));
}

}  // namespace

void MissValue::forgetBelow(double range) {
  const auto is_below = [&](double value) { return value < range; };
  values_.erase(std::remove_if(values_.begin(), values_.end(), is_below), values_.end());
}

void MissValue::mark(Scan& scan) {
  const double largest = largestRange(scan);
  if (largest <= 0.0) return;
  const double end = kMisses.end * largest;
  forgetBelow(end);
  const auto isKnown = [this](double range) {
    return std::find(values_.begin(), values_.end(), range) != values_.end();
  };
  const std::vector<Level> farthest = levelsOf(scan, end);
  const Level& candidate = *std::max_element(farthest.begin(), farthest.end(), isRarer);
  if (!isKnown(candidate.range) && isMiss(scan, candidate)) {
    values_.push_back(candidate.range);
  }
  for (std::size_t i = 0; !values_.empty() && i < scan.beams(); ++i) {
    if (scan.isValid(i) && isKnown(scan.ranges()[i])) scan.setKind(i, ReturnKind::kNothing);
  }
}

}  // namespace sightline::scan
