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
    levels_[level] = widened(levels_[level - 1], 1 << (level - 1));
  }
}

bool SearchRasters::show(const Submap& submap, const Eigen::Vector2d& centre_odom) const {
  return drawn_ == submap.version() && (centre_odom - centre_odom_).norm() < kRasters.redraw_at;
}

void SearchRasters::draw(const std::vector<Surfel>& surfels) {
  static const std::vector<std::uint8_t> smear = smearStamp();
  Raster& raster = levels_.front();
  raster.assign(indexOf(-1, -1) + 1, 0);
  for (const Surfel& surfel : surfels) {
    const Eigen::Vector2i cell = cellOf(surfel.position);
    const std::uint8_t* count = smear.data();
    for (int y = cell.y() - kHalf; y <= cell.y() + kHalf; ++y) {
      for (int x = cell.x() - kHalf; x <= cell.x() + kHalf; ++x, ++count) {
        std::uint8_t& here = raster[indexOf(x, y)];
        here = std::max(here, *count);
      }
    }
  }
}

// The most of each cell and of those so many cells further along x, along y and along both.
SearchRasters::Raster SearchRasters::widened(const Raster& raster, int shift) {
  Raster along_x = raster;
  for (int y = 0; y < kSide; ++y) {
    const std::uint8_t* from = &raster[indexOf(0, y)];
    std::uint8_t* to = &along_x[indexOf(0, y)];
    for (int x = 0; x < kSide - shift; ++x) to[x] = std::max(from[x], from[x + shift]);
    for (int x = kSide - shift; x < kSide; ++x) to[x] = std::max(from[x], from[x + shift - kSide]);
  }
  Raster both = along_x;
  for (int y = 0; y < kSide; ++y) {
    const std::uint8_t* further = &along_x[indexOf(0, y + shift)];
    std::uint8_t* to = &both[indexOf(0, y)];
    for (int x = 0; x < kSide; ++x) to[x] = std::max(to[x], further[x]);
  }
  return both;
}

}  // namespace sightline::dead_reckoning
