#include "sightline/dead_reckoning/search_rasters.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

namespace sightline::dead_reckoning {

namespace {

constexpr struct {
  // Path of the centre after which the rasters are drawn anew [m].
  double redraw_at = 4.0;
  // Distance from a surface at which a point counts nothing [m].
  double smear = 0.25;
  // Cosine of the angle from the middle of a quarter up to which surfaces belong to it: points at
  // its border may be seen turned by some 20°.
  double facing = 0.38;
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

// Quarter whose middle is nearest: about +x, +y, -x, -y.
std::size_t quarterOf(const Eigen::Vector2d& normal) {
  if (std::abs(normal.x()) >= std::abs(normal.y())) return normal.x() >= 0.0 ? 0 : 2;
  return normal.y() >= 0.0 ? 1 : 3;
}

// Tells whether a surface is near enough to a quarter for a point that faces there.
bool facesInto(const Eigen::Vector2d& normal, std::size_t quarter) {
  const double along = quarter % 2 == 0 ? normal.x() : normal.y();
  return (quarter < 2 ? along : -along) > kRasters.facing;
}

}  // namespace

// Memory that is not in use.
class SearchRasters::Store {
 public:
  static Store& get() {
    static Store store;
    return store;
  }

  // Pages are written once, or the first who uses them would have to wait for the system.
  void reserve(std::size_t count) {
    const std::lock_guard<std::mutex> lock(mutex_);
    while (free_.size() < count) {
      free_.emplace_back(new std::uint8_t[kBytes]);
      std::fill_n(free_.back().get(), kBytes, std::uint8_t{0});
    }
  }
  Memory take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (free_.empty()) return Memory(new std::uint8_t[kBytes]);
    Memory memory = std::move(free_.back());
    free_.pop_back();
    return memory;
  }
  void giveBack(Memory memory) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (free_.size() < kMost) free_.push_back(std::move(memory));
  }

 private:
  static constexpr std::size_t kBytes = kLevels * (kAll + 1) * kSize;
  static constexpr std::size_t kMost = 4;  // two references, the old rasters and the new

  std::mutex mutex_;
  std::vector<Memory> free_;
};

void SearchRasters::reserve() {
  Store::get().reserve(2);
}

SearchRasters::~SearchRasters() {
  Store::get().giveBack(std::move(counts_));
}

SearchRasters::SearchRasters(const Submap& submap, const Eigen::Vector2d& centre_odom)
    : counts_(Store::get().take()),
      drawn_(submap.version()),
      centre_odom_(centre_odom),
      corner_(centre_odom.array() - 0.5 * kCell * static_cast<double>(kSide)) {
  draw(submap.surfels());
  for (std::size_t level = 1; level < kLevels; ++level) {
    for (std::size_t facing = 0; facing <= kAll; ++facing) {
      widen(raster(level - 1, facing), 1 << (level - 1), raster(level, facing));
    }
  }
}

bool SearchRasters::show(const Submap& submap, const Eigen::Vector2d& centre_odom) const {
  return drawn_ == submap.version() && (centre_odom - centre_odom_).norm() < kRasters.redraw_at;
}

Eigen::Vector2i SearchRasters::placeOf(const Eigen::Vector2d& point_odom) const {
  return ((point_odom - corner_) / kCell).array().floor().max(-1e6).min(1e6).cast<int>().matrix();
}

SearchRasters::Cell SearchRasters::cellOf(const Eigen::Vector2d& point_odom,
                                          const Eigen::Vector2d& normal) const {
  const Eigen::Vector2i place = placeOf(point_odom);
  return {place.x(), place.y(), normal.isZero(0.0) ? kAll : quarterOf(normal)};
}

void SearchRasters::draw(const std::vector<Surfel>& surfels) {
  std::fill_n(raster(0, 0), (kAll + 1) * kSize, std::uint8_t{0});
  for (const Surfel& surfel : surfels) {
    const Eigen::Vector2i cell = placeOf(surfel.position);
    for (std::size_t quarter = 0; quarter < kAll; ++quarter) {
      if (facesInto(surfel.normal, quarter)) draw(cell, quarter);
    }
    draw(cell, kAll);
  }
}

void SearchRasters::draw(const Eigen::Vector2i& cell, std::size_t facing) {
  static const std::vector<std::uint8_t> smear = smearStamp();
  std::uint8_t* counts = raster(0, facing);
  const std::uint8_t* count = smear.data();
  for (int y = cell.y() - kHalf; y <= cell.y() + kHalf; ++y) {
    for (int x = cell.x() - kHalf; x <= cell.x() + kHalf; ++x, ++count) {
      std::uint8_t& here = counts[indexOf(x, y)];
      here = std::max(here, *count);
    }
  }
}

// The most of each cell and of those so many cells further along x, along y and along both.
void SearchRasters::widen(const std::uint8_t* narrow, int shift, std::uint8_t* wider) {
  static thread_local std::vector<std::uint8_t> along_x(kSize);
  for (int y = 0; y < kSide; ++y) {
    const std::uint8_t* from = &narrow[indexOf(0, y)];
    std::uint8_t* to = &along_x[indexOf(0, y)];
    for (int x = 0; x < kSide - shift; ++x) to[x] = std::max(from[x], from[x + shift]);
    for (int x = kSide - shift; x < kSide; ++x) to[x] = std::max(from[x], from[x + shift - kSide]);
  }
  for (int y = 0; y < kSide; ++y) {
    const std::uint8_t* here = &along_x[indexOf(0, y)];
    const std::uint8_t* further = &along_x[indexOf(0, y + shift)];
    std::uint8_t* to = &wider[indexOf(0, y)];
    for (int x = 0; x < kSide; ++x) to[x] = std::max(here[x], further[x]);
  }
}

}  // namespace sightline::dead_reckoning
