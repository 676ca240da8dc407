#include "sightline/dead_reckoning/search_rasters.h"

#include <algorithm>
#include <cmath>

namespace sightline::dead_reckoning {

namespace {

constexpr struct {
  // Extent of the rasters from their centre, and path of the centre after which they are drawn
  // anew [m].
  double reach = 25.6;
  double redraw_at = 4.0;
  // Count on a surface, and distance from it at which a point counts nothing [m].
  double full = SearchRasters::kFull;
  double smear = 0.25;
} kRasters;

std::vector<std::uint8_t> smearStamp(int half) {
  std::vector<std::uint8_t> stamp;
  for (int dy = -half; dy <= half; ++dy) {
    for (int dx = -half; dx <= half; ++dx) {
      const double distance = SearchRasters::kCell * std::hypot(dx, dy);
      const double count = std::round(kRasters.full * (1.0 - distance / kRasters.smear));
      stamp.push_back(static_cast<std::uint8_t>(std::max(0.0, count)));
    }
  }
  return stamp;
}

}  // namespace

SearchRasters::SearchRasters(const Submap& submap, const Eigen::Vector2d& centre_odom)
    : drawn_(submap.version()),
      centre_odom_(centre_odom),
      corner_(centre_odom.array() - kRasters.reach) {
  draw(submap.surfels());
  std::vector<Level> plain{levels_.front()};
  while (plain.size() < kLevels) {
    plain.push_back(halved(plain.back()));
    levels_.push_back(widened(plain.back()));
  }
}

bool SearchRasters::show(const Submap& submap, const Eigen::Vector2d& centre_odom) const {
  return drawn_ == submap.version() && (centre_odom - centre_odom_).norm() < kRasters.redraw_at;
}

void SearchRasters::draw(const std::vector<Surfel>& surfels) {
  static const int half = static_cast<int>(kRasters.smear / kCell);
  static const std::vector<std::uint8_t> smear = smearStamp(half);
  const int side = static_cast<int>(std::lround(2.0 * kRasters.reach / kCell));
  const auto stride = static_cast<std::size_t>(side);
  levels_ = {{kCell, static_cast<double>(side), stride, std::vector<std::uint8_t>(stride * stride)}};
  for (const Surfel& surfel : surfels) {
    const Eigen::Vector2d place = (surfel.position - corner_) / kCell;
    if (!(place.minCoeff() >= half && place.maxCoeff() < side - half)) continue;
    const std::uint8_t* count = smear.data();
    for (int y = static_cast<int>(place.y()) - half; y <= static_cast<int>(place.y()) + half; ++y) {
      const int x = static_cast<int>(place.x()) - half;
      std::uint8_t* cell = &levels_.front().counts[static_cast<std::size_t>(y * side + x)];
      for (int i = 0; i <= 2 * half; ++i, ++cell, ++count) *cell = std::max(*cell, *count);
    }
  }
}

// Cells twice as wide, with the most of the four that each holds.
SearchRasters::Level SearchRasters::halved(const Level& fine) {
  Level level{2.0 * fine.cell, 0.5 * fine.side, fine.stride / 2, {}};
  level.counts.reserve(level.stride * level.stride);
  for (std::size_t y = 0; y < level.stride; ++y) {
    const std::uint8_t* low = &fine.counts[2 * y * fine.stride];
    const std::uint8_t* high = low + fine.stride;
    for (std::size_t x = 0; x < 2 * level.stride; x += 2) {
      level.counts.push_back(
          std::max(std::max(low[x], low[x + 1]), std::max(high[x], high[x + 1])));
    }
  }
  return level;
}

// The most of each cell and of the next ones along x and y.
SearchRasters::Level SearchRasters::widened(const Level& cells) {
  Level level = cells;
  const std::size_t side = cells.stride;
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      std::uint8_t& most = level.counts[y * side + x];
      const bool has_right = x + 1 < side;
      if (has_right) most = std::max(most, cells.counts[y * side + x + 1]);
      if (y + 1 == side) continue;
      most = std::max(most, cells.counts[(y + 1) * side + x]);
      if (has_right) most = std::max(most, cells.counts[(y + 1) * side + x + 1]);
    }
  }
  return level;
}

}  // namespace sightline::dead_reckoning
