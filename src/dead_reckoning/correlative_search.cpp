#include "sightline/dead_reckoning/correlative_search.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

struct SearchTuning {
  // Distance from the sensor up to which points are counted [m].
  double farthest = 16.0;
  // Distance between points that are counted [m], so that near walls do not outvote the rest, and
  // the most of them.
  double thinning = 0.12;
  std::size_t most_points = 120;
  // Step of heading [rad].
  double heading = 0.03;
  // Blocks of positions that are divided; from then on the way down leads to the best part of each
  // alone, up to so many blocks.
  std::size_t most_divided = 2000;
  std::size_t most_looked = 2300;
  // Blocks that the search begins with at most.
  double most_blocks = 6'000.0;
  // Poses nearer to each other than this are one hypothesis [m, rad]; those that score less than
  // this share of the best are none.
  double apart_position = 0.35;
  double apart_heading = 0.1;
  double worthwhile = 0.6;
};
constexpr SearchTuning kSearch{};

// One point for each stretch.
std::vector<Eigen::Vector2d> thinOut(const std::vector<SurfacePoint>& points) {
  std::vector<Eigen::Vector2d> thinned;
  for (const SurfacePoint& point : points) {
    if (point.position.norm() > kSearch.farthest) continue;
    if (!thinned.empty() && (point.position - thinned.back()).norm() < kSearch.thinning) continue;
    thinned.push_back(point.position);
  }
  const std::size_t stride = thinned.size() / kSearch.most_points + 1;
  for (std::size_t i = 0; i * stride < thinned.size(); ++i) thinned[i] = thinned[i * stride];
  thinned.resize((thinned.size() + stride - 1) / stride);
  return thinned;
}

bool isTheSamePeak(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kSearch.apart_position &&
         std::abs(geometry::wrapAngle(a.theta() - b.theta())) < kSearch.apart_heading;
}

// Positions from a corner on, as far as a cell of the level, at one heading.
struct Block {
  Eigen::Vector2d corner;
  std::size_t heading;
  std::size_t level;
  long bound;  // what its points count at most, together

  bool operator<(const Block& other) const {
    return bound != other.bound ? bound < other.bound : level > other.level;
  }
};

struct Pose {
  Pose2 T_odom_base;
  long sum;  // what its points count, together
};

class BranchAndBound {
 public:
  BranchAndBound(const SearchRasters& rasters, const std::vector<Eigen::Vector2d>& points,
                 const SearchWindow& window)
      : rasters_(rasters), points_(points), window_(window) {
    const int steps = static_cast<int>(std::ceil(window.heading / kSearch.heading));
    for (int k = -steps; k <= steps; ++k) turnTo(window.centre.theta() + k * kSearch.heading);
    begin();
  }

  // The best poses that are not neighbours of a better one, best first.
  std::vector<Pose> find(std::size_t most) {
    std::vector<Pose> peaks;
    for (std::size_t looked = 0; !open_.empty() && peaks.size() < most;) {
      const Block block = open_.top();
      open_.pop();
      if (isCovered(block, peaks)) continue;
      if (!peaks.empty() && block.bound < kSearch.worthwhile * peaks.front().sum) break;
      if (block.level == 0) {
        peaks.push_back({Pose2(block.corner, headings_[block.heading]), block.bound});
      } else if (++looked < kSearch.most_divided) {
        for (const Block& part : partsOf(block)) open_.push(part);
      } else if (looked < kSearch.most_looked) {
        open_.push(bestIn(block));
      }
    }
    return peaks;
  }

  std::size_t evaluations() const { return evaluations_; }

 private:
  void turnTo(double heading) {
    headings_.push_back(heading);
    turned_.push_back(turned(heading));
  }

  std::vector<Eigen::Vector2d> turned(double heading) const {
    const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(heading).toRotationMatrix();
    std::vector<Eigen::Vector2d> turned;
    turned.reserve(points_.size());
    for (const Eigen::Vector2d& point : points_) turned.push_back(rotation * point);
    return turned;
  }

  static double cellOf(std::size_t level) {
    return SearchRasters::kCell * static_cast<double>(1 << level);
  }

  double blocksAt(std::size_t level) const {
    const double side = std::ceil((2.0 * window_.position + SearchRasters::kCell) / cellOf(level));
    return side * side * static_cast<double>(headings_.size());
  }

  // Blocks a quarter of the window wide, unless that is too many.
  void begin() {
    std::size_t level = 0;
    while (level + 1 < SearchRasters::kLevels &&
           (cellOf(level + 1) <= 0.5 * window_.position || blocksAt(level) > kSearch.most_blocks)) {
      ++level;
    }
    const double half = std::min(window_.position, widestAt(level));
    const auto side =
        static_cast<int>(std::ceil((2.0 * half + SearchRasters::kCell) / cellOf(level)));
    const Eigen::Vector2d corner = window_.centre.translation().array() - half;
    for (std::size_t k = 0; k < headings_.size(); ++k) {
      for (int i = 0; i < side * side; ++i) {
        const Eigen::Vector2d offset(i % side, i / side);
        open_.push(blockAt(corner + cellOf(level) * offset, k, level));
      }
    }
  }

  // Half side of the widest window that is searched in blocks of a level.
  double widestAt(std::size_t level) const {
    const double blocks = kSearch.most_blocks / static_cast<double>(headings_.size());
    return 0.5 * cellOf(level) * std::max(1.0, std::floor(std::sqrt(blocks)) - 1.0);
  }

  long sumAt(std::size_t level, const std::vector<Eigen::Vector2d>& points,
             const Eigen::Vector2d& position) {
    ++evaluations_;
    long sum = 0;
    for (const Eigen::Vector2d& point : points) sum += rasters_.at(level, point + position);
    return sum;
  }

  Block blockAt(const Eigen::Vector2d& corner, std::size_t heading, std::size_t level) {
    return {corner, heading, level, sumAt(level, turned_[heading], corner)};
  }

  std::vector<Block> partsOf(const Block& block) {
    std::vector<Block> parts;
    const double cell = cellOf(block.level - 1);
    for (const double x : {0.0, cell}) {
      for (const double y : {0.0, cell}) {
        parts.push_back(
            blockAt(block.corner + Eigen::Vector2d(x, y), block.heading, block.level - 1));
      }
    }
    return parts;
  }

  Block bestIn(Block block) {
    while (block.level > 0) {
      const std::vector<Block> parts = partsOf(block);
      block = *std::max_element(parts.begin(), parts.end());
    }
    return block;
  }

  // Tells whether all of a block is next to a peak that was found.
  bool isCovered(const Block& block, const std::vector<Pose>& peaks) const {
    const double cell = block.level == 0 ? 0.0 : cellOf(block.level);
    const Eigen::Vector2d opposite = block.corner.array() + cell;
    const double heading = headings_[block.heading];
    return std::any_of(peaks.begin(), peaks.end(), [&](const Pose& peak) {
      return isTheSamePeak(Pose2(block.corner, heading), peak.T_odom_base) &&
             isTheSamePeak(Pose2(opposite, heading), peak.T_odom_base);
    });
  }

  const SearchRasters& rasters_;
  const std::vector<Eigen::Vector2d>& points_;
  const SearchWindow& window_;
  std::vector<double> headings_;
  std::vector<std::vector<Eigen::Vector2d>> turned_;  // by heading
  std::priority_queue<Block> open_;
  std::size_t evaluations_ = 0;
};

}  // namespace

SearchResult searchRasters(const std::vector<SurfacePoint>& points, const SearchRasters& rasters,
                           const SearchWindow& window, std::size_t most) {
  const std::vector<Eigen::Vector2d> thinned = thinOut(points);
  if (thinned.empty()) return {};
  BranchAndBound search(rasters, thinned, window);
  const double full = static_cast<double>(SearchRasters::kFull * thinned.size());
  SearchResult result;
  for (const Pose& peak : search.find(most)) {
    result.candidates.push_back({peak.T_odom_base, static_cast<double>(peak.sum) / full});
  }
  result.evaluations = search.evaluations();
  return result;
}

}  // namespace sightline::dead_reckoning
