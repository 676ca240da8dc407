#include "sightline/dead_reckoning/translation_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sightline::dead_reckoning {

namespace {

constexpr int kFieldSide = static_cast<int>(2.0 * DistanceField::kReach / DistanceField::kCell);
constexpr int kCells = 4;  // along each side of the square that is searched

int cellIndex(double metres) {
  return static_cast<int>(std::floor((metres + DistanceField::kReach) / DistanceField::kCell));
}

bool isInside(int x, int y) {
  return x >= 0 && y >= 0 && x < kFieldSide && y < kFieldSide;
}

std::size_t flat(int x, int y) {
  return static_cast<std::size_t>(y) * kFieldSide + static_cast<std::size_t>(x);
}

double cellCentre(int index) {
  return (index + 0.5) * DistanceField::kCell - DistanceField::kReach;
}

// The positions that fill a square evenly, `cells` along each side, with their costs.
void lookOver(const CellCost& cost, const Eigen::Vector2d& centre, double half, int cells,
              std::vector<Minimum>& found) {
  const double cell = 2.0 * half / cells;
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const Eigen::Vector2d position =
          centre + Eigen::Vector2d((x + 0.5) * cell - half, (y + 0.5) * cell - half);
      found.push_back({position, cost(position, cell), 0});
    }
  }
}

bool isBetter(const Minimum& a, const Minimum& b) {
  return a.cost < b.cost;
}

// The best two places, where their squares are not the same.
void keepBest(double cell, std::vector<Minimum>& found) {
  std::sort(found.begin(), found.end(), isBetter);
  const auto second = std::find_if(found.begin(), found.end(), [&](const Minimum& other) {
    return (other.position - found.front().position).cwiseAbs().maxCoeff() > 0.5 * cell;
  });
  if (second != found.end()) found[1] = *second;
  found.resize(second != found.end() ? 2 : 1);
}

}  // namespace

void DistanceField::draw(const std::vector<SurfacePoint>& points, double max_distance) {
  max_distance_ = max_distance;
  distances_.assign(static_cast<std::size_t>(kFieldSide) * kFieldSide,
                    static_cast<float>(max_distance));
  for (const SurfacePoint& point : points) {
    if (point.position.cwiseAbs().maxCoeff() < kReach) paint(point.position);
  }
}

void DistanceField::paint(const Eigen::Vector2d& point) {
  const int half = static_cast<int>(std::ceil(max_distance_ / kCell));
  const int x0 = std::max(0, cellIndex(point.x()) - half);
  const int y0 = std::max(0, cellIndex(point.y()) - half);
  const int x1 = std::min(kFieldSide - 1, cellIndex(point.x()) + half);
  const int y1 = std::min(kFieldSide - 1, cellIndex(point.y()) + half);
  for (int y = y0; y <= y1; ++y) {
    const double dy = cellCentre(y) - point.y();
    for (int x = x0; x <= x1; ++x) {
      const double dx = cellCentre(x) - point.x();
      float& distance = distances_[flat(x, y)];
      distance = std::min(distance, static_cast<float>(std::sqrt(dx * dx + dy * dy)));
    }
  }
}

double DistanceField::cost(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& shift,
                           double truncation, double slack) const {
  double sum = 0.0;
  for (const Eigen::Vector2d& point : points) {
    const int x = cellIndex(point.x() + shift.x());
    const int y = cellIndex(point.y() + shift.y());
    const double distance =
        isInside(x, y) ? static_cast<double>(distances_[flat(x, y)]) : max_distance_;
    sum += std::clamp(distance - slack, 0.0, truncation);
  }
  return sum / (truncation * static_cast<double>(std::max<std::size_t>(1, points.size())));
}

Minimum searchIteratively(const CellCost& cost, const Eigen::Vector2d& centre, double half,
                          double resolution) {
  std::vector<Minimum> best{{centre, 0.0, 0}};
  std::size_t evaluations = 0;
  // The last cells are no larger than the resolution; rounding may leave them a trifle more.
  for (double width = half; 2.0 * width / kCells >= 0.99 * resolution; width *= 0.5) {
    std::vector<Minimum> found;
    for (const Minimum& place : best) lookOver(cost, place.position, width, kCells, found);
    evaluations += found.size();
    keepBest(2.0 * width / kCells, found);
    best = std::move(found);
  }
  best.front().evaluations = evaluations;
  return best.front();
}

Minimum searchUniformly(const CellCost& cost, const Eigen::Vector2d& centre, double half,
                        double resolution) {
  std::vector<Minimum> found;
  lookOver(cost, centre, half, static_cast<int>(std::lround(2.0 * half / resolution)), found);
  Minimum best = *std::min_element(found.begin(), found.end(), isBetter);
  best.evaluations = found.size();
  return best;
}

}  // namespace sightline::dead_reckoning
