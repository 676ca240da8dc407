#include "sightline/dead_reckoning/search_rasters.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

constexpr struct {
  // Path of the centre after which the rasters are drawn anew [m].
  double redraw_at = 4.0;
  // Distance from a surface at which a point counts nothing [m].
  double smear = 0.25;
} kRasters;
constexpr int kHalf = static_cast<int>(kRasters.smear / SearchRasters::kCell);

std::vector<std::uint8_t> smearStamp() {
  std::vector<std::uint8_t> stamp;
  for (int dy = -kHalf; dy <= kHalf; ++dy) {
    for (int dx = -kHalf; dx <= kHalf; ++dx) {
      const double distance = SearchRasters::kCell * std::hypot(dx, dy);
      const double count = std::round(SearchRasters::kFull * (1.0 - distance / kRasters.smear));
      stamp.push_back(static_cast<std::uint8_t>(std::max(0.0, count)));
    }
  }
  return stamp;
}

}  // namespace

SearchRasters::SearchRasters(const Submap& submap, const Eigen::Vector2d& centre_odom)
    : drawn_(submap.version()),
      centre_odom_(centre_odom),
      corner_(centre_odom.array() - 0.5 * kCell * static_cast<double>(kSide)) {
  draw(submap.surfels());
  for (std::size_t level = 1; level < kLevels; ++level) {
    levels_[level] = widened(levels_[level - 1], std::size_t{1} << (level - 1));
  }
}

bool SearchRasters::show(const Submap& submap, const Eigen::Vector2d& centre_odom) const {
  return drawn_ == submap.version() && (centre_odom - centre_odom_).norm() < kRasters.redraw_at;
}

void SearchRasters::draw(const std::vector<Surfel>& surfels) {
  static const std::vector<std::uint8_t> smear = smearStamp();
  levels_.front().assign(kSide * kSide, 0);
  for (const Surfel& surfel : surfels) {
    const Eigen::Vector2d place = (surfel.position - corner_) / kCell;
    if (!(place.minCoeff() >= kHalf && place.maxCoeff() < static_cast<double>(kSide) - kHalf)) {
      continue;
    }
    const auto x = static_cast<std::size_t>(place.x()) - kHalf;
    const auto y = static_cast<std::size_t>(place.y()) - kHalf;
    const std::uint8_t* count = smear.data();
    for (std::size_t row = y; row <= y + 2 * kHalf; ++row) {
      std::uint8_t* cell = &levels_.front()[row * kSide + x];
      for (int i = 0; i <= 2 * kHalf; ++i, ++cell, ++count) *cell = std::max(*cell, *count);
    }
  }
}

// The most of each cell and of those so many cells further along x, along y and along both.
SearchRasters::Raster SearchRasters::widened(const Raster& raster, std::size_t shift) {
  Raster along_x = raster;
  for (std::size_t y = 0; y < kSide; ++y) {
    const std::uint8_t* from = &raster[y * kSide];
    std::uint8_t* to = &along_x[y * kSide];
    for (std::size_t x = 0; x + shift < kSide; ++x) to[x] = std::max(from[x], from[x + shift]);
  }
  Raster both = along_x;
  for (std::size_t i = 0; i + shift * kSide < both.size(); ++i) {
    both[i] = std::max(along_x[i], along_x[i + shift * kSide]);
  }
  return both;
}

}  // namespace sightline::dead_reckoning
