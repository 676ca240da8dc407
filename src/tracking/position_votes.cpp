#include "sightline/tracking/position_votes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include "sightline/geometry/angle.h"

namespace sightline::tracking {

namespace {

constexpr struct {
  double near_axis = 0.26;  // 15°: directions that count as along an axis [rad]
  std::size_t block = 5;    // cells in either direction
  double least_share = 0.4;
  std::size_t most_cells = 4'000'000;  // of a map: beyond, cells are made larger
} kVotes;

// The way that a normal faces: 0 to 3 for +x, +y, −x, −y.
std::optional<int> facing(const Eigen::Vector2d& normal) {
  const double quarters = std::atan2(normal.y(), normal.x()) / (0.5 * geometry::kPi);
  const double nearest = std::round(quarters);
  if (std::abs(quarters - nearest) * 0.5 * geometry::kPi > kVotes.near_axis) return std::nullopt;
  return (static_cast<int>(nearest) + 4) % 4;
}

}  // namespace

PositionVotes::PositionVotes(const std::vector<SurfacePoint>& pieces, double frame, double cell)
    : frame_(frame), cell_(cell) {
  const Eigen::Rotation2Dd to_frame(-frame);
  Eigen::AlignedBox2d box;
  for (const SurfacePoint& piece : pieces) {
    const Eigen::Vector2d middle = to_frame * piece.position;
    box.extend(middle);
    const Eigen::Vector2d normal = to_frame * piece.normal;
    const Eigen::Vector2d half = 0.5 * piece.length * Eigen::Vector2d(normal.y(), -normal.x());
    box.extend(middle + half);
    box.extend(middle - half);
    const auto way = facing(normal);
    if (!way) continue;
    const int axis = *way % 2;
    const double along = middle[1 - axis];
    runs_[*way].push_back({middle[axis], along - 0.5 * piece.length, along + 0.5 * piece.length});
  }
  const Eigen::Vector2d extent = box.sizes();
  cell_ = std::max(cell, std::sqrt(extent.prod() / static_cast<double>(kVotes.most_cells)));
  origin_ = box.min();
  for (int i = 0; i < 2; ++i) size_[i] = static_cast<std::size_t>(extent[i] / cell_) + 2;
}

std::vector<PositionVotes::Place> PositionVotes::of(const std::vector<SurfacePoint>& points,
                                                    double heading) {
  for (Layer& layer : layers_) layer.cells.assign(size_[0] * size_[1] + size_[0] + 1, 0.0);
  for (const SurfacePoint& point : points) vote(point, heading - frame_);
  sumUp();
  return places();
}

void PositionVotes::vote(const SurfacePoint& point, double turn) {
  const Eigen::Rotation2Dd to_frame(turn);
  const auto way = facing(to_frame * point.normal);
  if (!way) return;
  const int axis = *way % 2;
  const Eigen::Vector2d position = to_frame * point.position;
  for (const Run& run : runs_[*way]) {
    const double across = run.across - position[axis];
    for (const int side : {-1, 0, 1}) {
      const double weight = side == 0 ? point.length : 0.5 * point.length;
      addRun(axis, across + side * cell_, run.from - position[1 - axis],
             run.to - position[1 - axis], weight);
    }
  }
}

void PositionVotes::addRun(int axis, double across, double from, double to, double weight) {
  const double row = (across - origin_[axis]) / cell_;
  if (row < 0.0 || row >= static_cast<double>(size_[axis])) return;
  const double last = static_cast<double>(size_[1 - axis]);
  const double begin = std::clamp((from - origin_[1 - axis]) / cell_, 0.0, last);
  const double end = std::clamp((to - origin_[1 - axis]) / cell_ + 1.0, 0.0, last);
  const auto line = static_cast<std::size_t>(row);
  const auto first = static_cast<std::size_t>(begin);
  const auto behind = static_cast<std::size_t>(end);
  auto& cells = layers_[axis].cells;
  const auto cellAt = [&](std::size_t i) { return axis == 0 ? index(line, i) : index(i, line); };
  cells[cellAt(first)] += weight;
  if (behind < size_[1 - axis]) cells[cellAt(behind)] -= weight;
}

void PositionVotes::sumUp() {
  for (std::size_t y = 1; y < size_[1]; ++y) {
    for (std::size_t x = 0; x < size_[0]; ++x) {
      layers_[0].cells[index(x, y)] += layers_[0].cells[index(x, y - 1)];
    }
  }
  for (std::size_t y = 0; y < size_[1]; ++y) {
    for (std::size_t x = 1; x < size_[0]; ++x) {
      layers_[1].cells[index(x, y)] += layers_[1].cells[index(x - 1, y)];
    }
  }
}

std::vector<PositionVotes::Place> PositionVotes::places() const {
  const Eigen::Rotation2Dd to_map(frame_);
  std::vector<Place> result;
  double best = 0.0;
  for (std::size_t top = 0; top < size_[1]; top += kVotes.block) {
    for (std::size_t left = 0; left < size_[0]; left += kVotes.block) {
      Place place;
      for (std::size_t y = top; y < std::min(top + kVotes.block, size_[1]); ++y) {
        for (std::size_t x = left; x < std::min(left + kVotes.block, size_[0]); ++x) {
          const double votes = at(index(x, y));
          if (votes <= place.votes) continue;
          const Eigen::Vector2d middle(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
          place = {to_map * (origin_ + cell_ * middle), votes};
        }
      }
      if (place.votes > 0.0) result.push_back(place);
      best = std::max(best, place.votes);
    }
  }
  const auto is_weak = [&](const Place& p) { return p.votes < kVotes.least_share * best; };
  result.erase(std::remove_if(result.begin(), result.end(), is_weak), result.end());
  return result;
}

}  // namespace sightline::tracking
