#include "sightline/dead_reckoning/correlative_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sightline/dead_reckoning/surprise.h"

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
  double heading = 0.04;
  // Share by which a block of a level promises less than its bound says: larger ones are divided
  // later, so that the first poses are found sooner.
  double doubt_per_level = 0.06;
  // Blocks of positions that are divided; from then on the way down leads to the best part of each
  // alone, up to so many blocks.
  std::size_t most_divided = 4000;
  std::size_t most_looked = 4300;
  // Blocks that the search begins with at most.
  double most_blocks = 6'000.0;
  // Poses nearer to each other than this are one hypothesis [m, rad]; those that score less than
  // this share of the best are none.
  double apart_position = 0.35;
  double apart_heading = 0.1;
  double worthwhile = 0.65;
};
constexpr SearchTuning kSearch{};

// One point for each stretch.
std::vector<SurfacePoint> thinOut(const std::vector<SurfacePoint>& points) {
  std::vector<SurfacePoint> thinned;
  for (const SurfacePoint& point : points) {
    if (point.position.norm() > kSearch.farthest) continue;
    if (!thinned.empty() && (point.position - thinned.back().position).norm() < kSearch.thinning) {
      continue;
    }
    thinned.push_back(point);
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

// Positions from a corner on, at one heading: as many cells along x and y as its level stands for.
struct Block {
  int x;  // of its corner, from that of the window [cells]
  int y;
  std::size_t heading;
  std::size_t level;
  int bound;  // what its points count at most, together, less what its distance from the prior
              // costs

  // A block promises the less the larger it is, as its bound is further from what is in it.
  double promise() const {
    return bound * (1.0 - kSearch.doubt_per_level * static_cast<double>(level));
  }
  bool operator<(const Block& other) const { return promise() < other.promise(); }
};

struct Pose {
  Pose2 T_odom_base;
  int sum;  // what its points count, together, less what its distance from the prior costs
};

class BranchAndBound {
 public:
  BranchAndBound(const SearchRasters& rasters, const std::vector<SurfacePoint>& points,
                 const SearchWindow& window, const Eigen::Vector3d& sigma)
      : rasters_(rasters),
        full_(SearchRasters::kFull * static_cast<double>(points.size())),
        centre_(window.centre),
        precision_(sigma.cwiseInverse()),
        level_(firstLevel(window)) {
    const int headings = headingsOf(window);
    const int blocks = blocksAlong(window, level_);
    corner_ = window.centre.translation().array() -
              std::min(window.position, 0.5 * sizeOf(level_) * blocks);
    for (int k = -headings; k <= headings; ++k) {
      turnTo(window.centre.theta() + k * kSearch.heading, points);
      begin(blocks);
    }
  }

  // The best poses that are not neighbours of a better one, best first.
  std::vector<Pose> find(std::size_t most) {
    std::vector<Pose> peaks;
    for (std::size_t looked = 0; !open_.empty() && peaks.size() < most;) {
      const Block block = open_.top();
      open_.pop();
      if (!peaks.empty() && block.promise() < kSearch.worthwhile * peaks.front().sum) break;
      if (isCovered(block, peaks)) continue;
      if (block.level == 0) {
        peaks.push_back({poseAt(block, 0), block.bound});
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
  // Side of a block [cells], and in metres.
  static int cellsOf(std::size_t level) { return 1 << level; }
  static double sizeOf(std::size_t level) { return SearchRasters::kCell * cellsOf(level); }

  // Headings to either side of the middle.
  static int headingsOf(const SearchWindow& window) {
    return static_cast<int>(std::ceil(window.heading / kSearch.heading));
  }

  // Blocks along a side of the window, of which no more than can be looked at.
  static int blocksAlong(const SearchWindow& window, std::size_t level) {
    const double wanted = std::ceil((2.0 * window.position + SearchRasters::kCell) / sizeOf(level));
    const double most = std::sqrt(kSearch.most_blocks / (2.0 * headingsOf(window) + 1.0));
    return static_cast<int>(std::min(wanted, std::max(1.0, std::floor(most))));
  }

  // Blocks are a quarter of the window wide, or wider where that is too many.
  static std::size_t firstLevel(const SearchWindow& window) {
    std::size_t level = 0;
    while (level + 1 < SearchRasters::kLevels &&
           (sizeOf(level + 1) <= 0.5 * window.position ||
            blocksAlong(window, level) * sizeOf(level) < 2.0 * window.position)) {
      ++level;
    }
    return level;
  }

  void turnTo(double heading, const std::vector<SurfacePoint>& points) {
    const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(heading).toRotationMatrix();
    std::vector<SearchRasters::Cell> cells;
    cells.reserve(points.size());
    for (const SurfacePoint& point : points) {
      cells.push_back(
          rasters_.cellOf(rotation * point.position + corner_, rotation * point.normal));
    }
    headings_.push_back(heading);
    cells_.push_back(std::move(cells));
  }

  void begin(int blocks) {
    for (int i = 0; i < blocks * blocks; ++i) {
      const int x = cellsOf(level_) * (i % blocks);
      open_.push(blockAt(x, cellsOf(level_) * (i / blocks), headings_.size() - 1, level_));
    }
  }

  Block blockAt(int x, int y, std::size_t heading, std::size_t level) {
    ++evaluations_;
    const int sum = rasters_.sum(level, cells_[heading], x, y);
    return {x, y, heading, level, sum - surprise(x, y, heading, level)};
  }

  // Distance of a number from a stretch from `first` on.
  static double outside(double value, double first, double length) {
    return std::max({first - value, value - first - length, 0.0});
  }

  // What the distance of the nearest of a block's poses from the prior costs.
  int surprise(int x, int y, std::size_t heading, std::size_t level) const {
    const double size = sizeOf(level) - SearchRasters::kCell;
    const Eigen::Vector3d off(outside(centre_.x(), corner_.x() + SearchRasters::kCell * x, size),
                              outside(centre_.y(), corner_.y() + SearchRasters::kCell * y, size),
                              geometry::wrapAngle(headings_[heading] - centre_.theta()));
    return static_cast<int>(full_ * surpriseCost(off.cwiseProduct(precision_).squaredNorm()));
  }

  std::array<Block, 4> partsOf(const Block& block) {
    const std::size_t level = block.level - 1;
    const auto part = [&](int x, int y) {
      return blockAt(block.x + x * cellsOf(level), block.y + y * cellsOf(level), block.heading,
                     level);
    };
    return {part(0, 0), part(1, 0), part(0, 1), part(1, 1)};
  }

  Block bestIn(Block block) {
    while (block.level > 0) {
      const auto parts = partsOf(block);
      block = *std::max_element(parts.begin(), parts.end());
    }
    return block;
  }

  // Pose so many cells from the corner of a block.
  Pose2 poseAt(const Block& block, int cells) const {
    const Eigen::Vector2d offset(block.x + cells, block.y + cells);
    return {corner_ + SearchRasters::kCell * offset, headings_[block.heading]};
  }

  // Tells whether all of a block is next to a peak that was found.
  bool isCovered(const Block& block, const std::vector<Pose>& peaks) const {
    const Pose2 first = poseAt(block, 0);
    const Pose2 last = poseAt(block, cellsOf(block.level) - 1);
    return std::any_of(peaks.begin(), peaks.end(), [&](const Pose& peak) {
      return isTheSamePeak(first, peak.T_odom_base) && isTheSamePeak(last, peak.T_odom_base);
    });
  }

  const SearchRasters& rasters_;
  double full_;  // what all points count on surfaces
  Pose2 centre_;
  Eigen::Vector3d precision_;  // 1/σ of the prior's coordinates
  std::size_t level_;
  Eigen::Vector2d corner_;
  std::vector<double> headings_;
  std::vector<std::vector<SearchRasters::Cell>> cells_;  // of the points, by heading
  std::priority_queue<Block> open_;
  std::size_t evaluations_ = 0;
};

}  // namespace

SearchResult searchRasters(const std::vector<SurfacePoint>& points, const SearchRasters& rasters,
                           const SearchWindow& window, const Eigen::Vector3d& sigma,
                           std::size_t most) {
  const std::vector<SurfacePoint> thinned = thinOut(points);
  if (thinned.empty()) return {};
  BranchAndBound search(rasters, thinned, window, sigma);
  const double full = SearchRasters::kFull * static_cast<double>(thinned.size());
  SearchResult result;
  for (const Pose& peak : search.find(most)) {
    result.candidates.push_back({peak.T_odom_base, static_cast<double>(peak.sum) / full});
  }
  result.evaluations = search.evaluations();
  return result;
}

}  // namespace sightline::dead_reckoning
