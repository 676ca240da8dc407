#include "sightline/dead_reckoning/correlative_search.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace sightline::dead_reckoning {

namespace {

using geometry::Pose2;

struct RasterTuning {
  // Lengths [m]: extent of the rasters from their centre; distance from the sensor up to which
  // points are counted; path of the centre after which the rasters are drawn anew; widest window
  // that is searched, which leaves the rasters a margin for the points.
  double reach = 24.0;
  double farthest = 16.0;
  double redraw_at = 4.0;
  double widest_search = 12.0;
  // Distance between points that are counted [m], so that near walls do not outvote the rest.
  double thinning = 0.12;
  // Cells, and the distance from a surface at which a point counts nothing [m].
  double coarse_cell = 0.4;
  double coarse_smear = 0.6;
  double fine_cell = 0.1;
  double fine_smear = 0.25;
  // Steps of heading [rad], and the fine step of position in cells.
  double coarse_heading = 0.04;
  double fine_heading = 0.02;
  int fine_stride = 2;
  // Coarse poses that are looked at more closely: one in `share_kept`, within these bounds.
  std::size_t share_kept = 10;
  std::size_t least_kept = 40;
  std::size_t most_kept = 400;
  // Poses nearer to each other than this are one hypothesis [m, rad]; those that score less than
  // this share of the best are none.
  double apart_position = 0.35;
  double apart_heading = 0.1;
  double worthwhile = 0.6;
};
constexpr RasterTuning kRaster{};
constexpr int kFull = 255;

// One point for each stretch.
std::vector<Eigen::Vector2d> thinOut(const std::vector<SurfacePoint>& points) {
  std::vector<Eigen::Vector2d> thinned;
  for (const SurfacePoint& point : points) {
    if (point.position.norm() > kRaster.farthest) continue;
    if (!thinned.empty() && (point.position - thinned.back()).norm() < kRaster.thinning) continue;
    thinned.push_back(point.position);
  }
  return thinned;
}

bool isTheSamePeak(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kRaster.apart_position &&
         std::abs(geometry::wrapAngle(a.theta() - b.theta())) < kRaster.apart_heading;
}

// A pose of the search.
struct Step {
  double x;
  double y;
  double heading;
  long sum;  // what its points count, together
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
    if (!best.empty() && candidate.score < kRaster.worthwhile * best.front().score) break;
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

  std::size_t poses() const {
    const auto side = static_cast<std::size_t>(2 * positions + 1);
    return side * side * static_cast<std::size_t>(2 * headings + 1);
  }
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
  const std::size_t wanted =
      std::clamp(steps.size() / kRaster.share_kept, kRaster.least_kept, kRaster.most_kept);
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
      side_(static_cast<int>(2.0 * kRaster.reach / cell)),
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

SearchRasters::SearchRasters(const Submap& submap, const Eigen::Vector2d& centre_odom)
    : coarse_(kRaster.coarse_cell, kRaster.coarse_smear),
      fine_(kRaster.fine_cell, kRaster.fine_smear),
      drawn_(submap.version()),
      centre_odom_(centre_odom) {
  coarse_.draw(submap.surfels(), centre_odom);
  fine_.draw(submap.surfels(), centre_odom);
}

bool SearchRasters::show(const Submap& submap, const Eigen::Vector2d& centre_odom) const {
  return drawn_ == submap.version() && (centre_odom - centre_odom_).norm() < kRaster.redraw_at;
}

SearchResult searchRasters(const std::vector<SurfacePoint>& points, const SearchRasters& rasters,
                           const SearchWindow& window, std::size_t most) {
  const std::vector<Eigen::Vector2d> thinned = thinOut(points);
  if (thinned.empty()) return {};
  const double position = std::min(window.position, kRaster.widest_search);
  const Grid coarse{static_cast<int>(std::ceil(window.heading / kRaster.coarse_heading)),
                    static_cast<int>(std::ceil(position / kRaster.coarse_cell)),
                    kRaster.coarse_heading, 1};
  std::vector<Step> starts;
  Scorer(rasters.coarse(), thinned).scoreAll(window.centre, coarse, [&](const Step& step) {
    starts.push_back(step);
  });
  SearchResult result;
  result.evaluations = starts.size();
  const Grid about{1, 1, kRaster.fine_heading, kRaster.fine_stride};
  std::vector<Step> all;
  Scorer fine(rasters.fine(), thinned);
  for (const Step& start : bestOf(starts)) all.push_back(bestAbout(start, about, fine));
  result.evaluations += all.size() * about.poses();
  result.candidates = bestApart(all, thinned.size(), most);
  return result;
}

}  // namespace sightline::dead_reckoning
