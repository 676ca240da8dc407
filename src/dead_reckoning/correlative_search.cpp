#include "sightline/dead_reckoning/correlative_search.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

constexpr double kReach = 24.0;     // of the rasters from their centre [m]
constexpr double kFarthest = 16.0;  // of the points that are counted [m]
constexpr double kRedrawAt = 4.0;   // they are drawn anew when the centre has moved so far [m]
constexpr double kThinning = 0.12;  // of the points that are counted [m]
constexpr int kFull = 255;
// Steps of the search: those in position are whole cells.
constexpr double kCoarseHeading = 0.04;  // [rad]
constexpr double kFineHeading = 0.02;    // [rad]
constexpr int kFineStride = 2;
// Of the coarse poses so many are looked at more closely.
constexpr std::size_t kShareKept = 10;
constexpr std::size_t kLeastKept = 40;
constexpr std::size_t kMostKept = 400;
// Poses nearer to each other than this are one hypothesis.
constexpr double kApartPosition = 0.35;  // [m]
constexpr double kApartHeading = 0.1;    // [rad]
// Poses that score less than this share of the best are none.
constexpr double kWorthwhile = 0.6;

// One point for each stretch, so that near walls do not outvote the rest.
std::vector<Eigen::Vector2d> thinOut(const std::vector<SurfacePoint>& points) {
  std::vector<Eigen::Vector2d> thinned;
  for (const SurfacePoint& point : points) {
    if (point.position.norm() > kFarthest) continue;
    if (!thinned.empty() && (point.position - thinned.back()).norm() < kThinning) continue;
    thinned.push_back(point.position);
  }
  return thinned;
}

bool isTheSamePeak(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kApartPosition &&
         std::abs(geometry::wrapAngle(a.theta() - b.theta())) < kApartHeading;
}

// A pose of the search.
struct Step {
  double x;
  double y;
  double heading;
  long sum;  // of what its points count
};

bool isBetter(const Step& a, const Step& b) {
  return a.sum > b.sum;
}

std::vector<SearchCandidate> bestApart(std::vector<Step>& all, std::size_t points,
                                       std::size_t most) {
  std::sort(all.begin(), all.end(), isBetter);
  const double full = static_cast<double>(kFull) * static_cast<double>(points);
  std::vector<SearchCandidate> best;
  for (const Step& step : all) {
    const SearchCandidate candidate{Pose2(step.x, step.y, step.heading),
                                    static_cast<double>(step.sum) / full};
    if (best.size() == most) break;
    if (!best.empty() && candidate.score < kWorthwhile * best.front().score) break;
    const bool known = std::any_of(best.begin(), best.end(), [&](const SearchCandidate& other) {
      return isTheSamePeak(candidate.T_odom_base, other.T_odom_base);
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
      : raster_(raster), points_(points) {}

  // Hands each pose of the grid to `visit`, with its score.
  template <class Visit>
  void scoreAll(const Pose2& centre, const Grid& grid, const Visit& visit) {
    const double step = grid.stride * raster_.cell();
    for (int k = -grid.headings; k <= grid.headings; ++k) {
      const double heading = centre.theta() + k * grid.heading_step;
      findCells(centre.translation(), heading, grid.stride * grid.positions);
      for (int y = -grid.positions; y <= grid.positions; ++y) {
        for (int x = -grid.positions; x <= grid.positions; ++x) {
          const long sum = raster_.sum(cells_, grid.stride * x, grid.stride * y);
          visit(Step{centre.x() + x * step, centre.y() + y * step, heading, sum});
        }
      }
    }
  }

 private:
  void findCells(const Eigen::Vector2d& position, double heading, int margin) {
    const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(heading).toRotationMatrix();
    cells_.clear();
    for (const Eigen::Vector2d& point : points_) {
      const auto cell = raster_.indexOf(rotation * point + position, margin);
      if (cell) cells_.push_back(*cell);
    }
  }

  const Raster& raster_;
  const std::vector<Eigen::Vector2d>& points_;
  std::vector<std::int32_t> cells_;
};

Step bestAbout(const Step& start, const Grid& grid, Scorer& scorer) {
  Step best = start;
  best.sum = -1;
  scorer.scoreAll(Pose2(start.x, start.y, start.heading), grid, [&](const Step& step) {
    if (step.sum > best.sum) best = step;
  });
  return best;
}

// The best share of them, but not fewer than a few.
std::vector<Step> bestOf(std::vector<Step>& steps) {
  const std::size_t wanted = std::clamp(steps.size() / kShareKept, kLeastKept, kMostKept);
  const std::size_t kept = std::min(steps.size(), wanted);
  std::partial_sort(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(kept), steps.end(),
                    isBetter);
  steps.resize(kept);
  return steps;
}

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

std::optional<std::int32_t> Raster::indexOf(const Eigen::Vector2d& point_odom, int margin) const {
  const Eigen::Vector2i cell = cellOf(point_odom);
  if (cell.minCoeff() < margin || cell.maxCoeff() >= side_ - margin) return std::nullopt;
  return cell.y() * side_ + cell.x();
}

long Raster::sum(const std::vector<std::int32_t>& cells, int dx, int dy) const {
  const std::uint8_t* shifted = cells_.data() + dy * side_ + dx;
  long sum = 0;
  for (const std::int32_t cell : cells) sum += shifted[cell];
  return sum;
}

void CorrelativeSearch::draw(const Submap& submap, const Eigen::Vector2d& centre_odom) {
  if (drawn_ == submap.version() && (centre_odom - centre_).norm() < kRedrawAt) return;
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
  std::vector<Step> starts;
  Scorer(coarse_, thinned).scoreAll(window.centre, coarse, [&](const Step& step) {
    starts.push_back(step);
  });
  std::vector<Step> all;
  Scorer fine(fine_, thinned);
  for (const Step& start : bestOf(starts)) {
    all.push_back(bestAbout(start, {1, 1, kFineHeading, kFineStride}, fine));
  }
  return bestApart(all, thinned.size(), most);
}

}  // namespace sightline::dead_reckoning
