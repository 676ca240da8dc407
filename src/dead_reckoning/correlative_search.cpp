#include "sightline/dead_reckoning/correlative_search.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

constexpr double kReach = 20.0;    // of the rasters from their centre [m]
constexpr double kMargin = 4.0;    // they are drawn anew when the centre has moved so far [m]
constexpr double kSpacing = 0.12;  // of the points that are counted [m]
constexpr int kFull = 255;
// Steps of the search: those in position are whole cells.
constexpr double kCoarseHeading = 0.04;  // [rad]
constexpr double kFineHeading = 0.02;    // [rad]
constexpr int kFineStride = 2;
constexpr std::size_t kKept = 400;  // of the coarse poses
// Poses nearer to each other than this are one hypothesis.
constexpr double kDistinctPosition = 0.35;  // [m]
constexpr double kDistinctHeading = 0.1;    // [rad]
// Poses that score less than this share of the best are none.
constexpr double kWorthwhile = 0.6;

// One point for each stretch, so that near walls do not outvote the rest.
std::vector<Eigen::Vector2d> thinOut(const std::vector<SurfacePoint>& points) {
  std::vector<Eigen::Vector2d> thinned;
  for (const SurfacePoint& point : points) {
    if (point.position.norm() > kReach - kMargin) continue;
    if (!thinned.empty() && (point.position - thinned.back()).norm() < kSpacing) continue;
    thinned.push_back(point.position);
  }
  return thinned;
}

bool isNeighbour(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kDistinctPosition &&
         std::abs(geometry::wrapAngle(a.theta() - b.theta())) < kDistinctHeading;
}

bool isBetter(const SearchCandidate& a, const SearchCandidate& b) {
  return a.score > b.score;
}

std::vector<SearchCandidate> bestApart(std::vector<SearchCandidate>& all, std::size_t most) {
  std::sort(all.begin(), all.end(), isBetter);
  std::vector<SearchCandidate> best;
  for (const SearchCandidate& candidate : all) {
    if (best.size() == most || candidate.score < kWorthwhile * all.front().score) break;
    const bool known = std::any_of(best.begin(), best.end(), [&](const SearchCandidate& other) {
      return isNeighbour(candidate.T_odom_base, other.T_odom_base);
    });
    if (!known) best.push_back(candidate);
  }
  return best;
}

// Steps of a search about a pose.
struct Grid {
  int headings;  // to either side
  int positions;
  double heading_step;  // [rad]
  int stride;           // [cells]
};

class Scorer {
 public:
  Scorer(const Raster& raster, const std::vector<Eigen::Vector2d>& points)
      : raster_(raster), points_(points), cells_(points.size()) {}

  void scoreAll(const Pose2& centre, const Grid& grid, std::vector<SearchCandidate>& all) {
    for (int k = -grid.headings; k <= grid.headings; ++k) {
      const Pose2 turned(centre.translation(), centre.theta() + k * grid.heading_step);
      findCells(turned);
      for (int y = -grid.positions; y <= grid.positions; ++y) {
        for (int x = -grid.positions; x <= grid.positions; ++x) {
          const double score = raster_.score(cells_, grid.stride * x, grid.stride * y);
          const Eigen::Vector2d shift = grid.stride * raster_.cell() * Eigen::Vector2d(x, y);
          all.push_back({Pose2(turned.translation() + shift, turned.theta()), score});
        }
      }
    }
  }

 private:
  void findCells(const Pose2& pose) {
    const Eigen::Matrix2d rotation = pose.rotation();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      cells_[i] = raster_.cellOf(rotation * points_[i] + pose.translation());
    }
  }

  const Raster& raster_;
  const std::vector<Eigen::Vector2d>& points_;
  std::vector<Eigen::Vector2i> cells_;
};

}  // namespace

Raster::Raster(double cell, double smear)
    : cell_(cell),
      half_(static_cast<int>(smear / cell)),
      side_(static_cast<int>(2.0 * kReach / cell)),
      cells_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), 0) {
  for (int dy = -half_; dy <= half_; ++dy) {
    for (int dx = -half_; dx <= half_; ++dx) {
      const double distance = cell * std::hypot(dx, dy);
      stamp_.push_back(
          static_cast<std::uint8_t>(std::max(0.0, std::round(kFull * (1.0 - distance / smear)))));
    }
  }
}

void Raster::draw(const std::vector<Surfel>& surfels, const Eigen::Vector2d& centre_odom) {
  corner_ = centre_odom - Eigen::Vector2d::Constant(0.5 * side_ * cell_);
  std::fill(cells_.begin(), cells_.end(), std::uint8_t{0});
  for (const Surfel& surfel : surfels) paint(cellOf(surfel.position));
}

Eigen::Vector2i Raster::cellOf(const Eigen::Vector2d& point_odom) const {
  // Far outside stays outside, and within an int.
  return ((point_odom - corner_) / cell_).array().floor().max(-1e6).min(1e6).cast<int>().matrix();
}

void Raster::paint(const Eigen::Vector2i& centre) {
  if (centre.minCoeff() < half_ || centre.maxCoeff() >= side_ - half_) return;
  const std::uint8_t* stamp = stamp_.data();
  for (int y = centre.y() - half_; y <= centre.y() + half_; ++y) {
    std::uint8_t* row = &cells_[static_cast<std::size_t>(y * side_ + centre.x() - half_)];
    for (int x = 0; x <= 2 * half_; ++x, ++row, ++stamp) *row = std::max(*row, *stamp);
  }
}

double Raster::score(const std::vector<Eigen::Vector2i>& cells, int dx, int dy) const {
  int sum = 0;
  for (const Eigen::Vector2i& cell : cells) {
    const int x = cell.x() + dx;
    const int y = cell.y() + dy;
    if (x < 0 || y < 0 || x >= side_ || y >= side_) continue;
    sum += cells_[static_cast<std::size_t>(y * side_ + x)];
  }
  return static_cast<double>(sum) / (kFull * static_cast<double>(cells.size()));
}

void CorrelativeSearch::draw(const Submap& submap, const Eigen::Vector2d& centre_odom) {
  if (drawn_ == submap.version() && (centre_odom - centre_).norm() < kMargin) return;
  drawn_ = submap.version();
  centre_ = centre_odom;
  coarse_.draw(submap.surfels(), centre_odom);
  fine_.draw(submap.surfels(), centre_odom);
}

std::vector<SearchCandidate> CorrelativeSearch::search(const std::vector<SurfacePoint>& points,
                                                       const Submap& submap,
                                                       const SearchWindow& window,
                                                       std::size_t most) {
  const std::vector<Eigen::Vector2d> thinned = thinOut(points);
  if (thinned.empty()) return {};
  draw(submap, window.centre.translation());
  const Grid coarse{static_cast<int>(std::ceil(window.heading / kCoarseHeading)),
                    static_cast<int>(std::ceil(window.position / coarse_.cell())), kCoarseHeading,
                    1};
  std::vector<SearchCandidate> starts;
  Scorer(coarse_, thinned).scoreAll(window.centre, coarse, starts);
  const auto kept = static_cast<std::ptrdiff_t>(std::min(kKept, starts.size()));
  std::partial_sort(starts.begin(), starts.begin() + kept, starts.end(), isBetter);
  starts.resize(static_cast<std::size_t>(kept));
  std::vector<SearchCandidate> all;
  Scorer fine(fine_, thinned);
  for (const SearchCandidate& start : starts) {
    fine.scoreAll(start.T_odom_base, {1, 1, kFineHeading, kFineStride}, all);
  }
  return bestApart(all, most);
}

}  // namespace sightline::dead_reckoning
