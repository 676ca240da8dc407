#include "sightline/mapping/grid_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <unordered_map>

#include "grid_surfaces.h"
#include "sightline/config/error.h"

namespace sightline::mapping {

namespace {

using geometry::Pose2;
using world::Occupancy;

constexpr struct {
  double step = 0.2;       // between places of the path [m]
  double clearance = 0.2;  // of a robot's middle from what is not free [m]
  double spacing = 0.6;    // of the places that are looked from [m]
  double range = 10.0;     // of a look [m]
  int beams = 720;
  double least_floor = 1.5;                // that a path is worth [m²]
  std::int64_t between = 100'000'000;      // places of the path [ns]
  std::int64_t apart = 3'600'000'000'000;  // floors that nothing joins [ns]
} kLook{};

// Places of the path: every few cells, where a robot fits.
class Lattice {
 public:
  explicit Lattice(const Occupancy& grid) : grid_(grid) {
    stride_ = std::max(1, static_cast<int>(std::lround(kLook.step / grid.resolution)));
    width_ = static_cast<int>(grid.width) / stride_;
    height_ = static_cast<int>(grid.height) / stride_;
    is_place_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), false);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) is_place_[at(x, y)] = fits(cellOf(x), cellOf(y));
    }
  }

  // Walks all places that can be reached from one another, back over where it came from.
  std::vector<std::vector<Eigen::Vector2d>> walks() {
    std::vector<std::vector<Eigen::Vector2d>> walks;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (!is_place_[at(x, y)]) continue;
        auto walk = walkFrom(x, y);
        const double floor = 0.5 * static_cast<double>(walk.size()) * step() * step();
        if (floor >= kLook.least_floor) walks.push_back(std::move(walk));
      }
    }
    return walks;
  }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  int cellOf(int i) const { return i * stride_ + stride_ / 2; }
  double step() const { return stride_ * grid_.resolution; }
  Eigen::Vector2d placeOf(int x, int y) const {
    return grid_.resolution * Eigen::Vector2d(cellOf(x) + 0.5, cellOf(y) + 0.5);
  }

  bool fits(int x, int y) const {
    const int reach = static_cast<int>(kLook.clearance / grid_.resolution);
    const int width = static_cast<int>(grid_.width);
    const int height = static_cast<int>(grid_.height);
    for (int cy = y - reach; cy <= y + reach; ++cy) {
      for (int cx = x - reach; cx <= x + reach; ++cx) {
        if (cx < 0 || cy < 0 || cx >= width || cy >= height) return false;
        const auto i = static_cast<std::size_t>(cy) * grid_.width + static_cast<std::size_t>(cx);
        if (grid_.cells[i] != Occupancy::kFree) return false;
      }
    }
    return true;
  }

  // Depth first; a place is used up when it is entered.
  std::vector<Eigen::Vector2d> walkFrom(int x, int y) {
    constexpr int kRight[] = {1, 0, -1, 0};
    constexpr int kUp[] = {0, 1, 0, -1};
    std::vector<std::array<int, 3>> way{{x, y, 0}};
    std::vector<Eigen::Vector2d> walk{placeOf(x, y)};
    is_place_[at(x, y)] = false;
    while (!way.empty()) {
      auto& [here_x, here_y, next] = way.back();
      if (next == 4) {
        way.pop_back();
        if (!way.empty()) walk.push_back(placeOf(way.back()[0], way.back()[1]));
        continue;
      }
      const int nx = here_x + kRight[next];
      const int ny = here_y + kUp[next];
      ++next;
      if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_ || !is_place_[at(nx, ny)]) continue;
      is_place_[at(nx, ny)] = false;
      walk.push_back(placeOf(nx, ny));
      way.push_back({nx, ny, 0});
    }
    return walk;
  }

  const Occupancy& grid_;
  int stride_ = 1;
  int width_ = 0;
  int height_ = 0;
  std::vector<bool> is_place_;
};

// What is seen of a grid from a place in it.
class GridEye {
 public:
  GridEye(const Occupancy& grid, double surface)
      : grid_(grid),
        surfaces_(grid, surface),
        seen_(grid.cells.size() * GridSurfaces::kWays, false) {}

  KeyScan look(const Eigen::Vector2d& from) {
    KeyScan key;
    for (int i = 0; i < kLook.beams; ++i) {
      cast(from, 2.0 * geometry::kPi * i / kLook.beams, key);
    }
    for (const std::size_t face : faces_) seen_[face] = false;
    faces_.clear();
    return key;
  }

 private:
  // From cell to cell along a ray (Amanatides and Woo 1987).
  void cast(const Eigen::Vector2d& from, double angle, KeyScan& key) {
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    int cell[2];
    double next[2];
    double pace[2];
    int sign[2];
    for (int axis = 0; axis < 2; ++axis) {
      const double place = from[axis] / grid_.resolution;
      cell[axis] = static_cast<int>(std::floor(place));
      sign[axis] = ray[axis] < 0.0 ? -1 : 1;
      pace[axis] = std::abs(ray[axis]) < 1e-9 ? 1e9 : grid_.resolution / std::abs(ray[axis]);
      next[axis] = pace[axis] * (sign[axis] > 0 ? cell[axis] + 1 - place : place - cell[axis]);
    }
    while (true) {
      const int axis = next[0] < next[1] ? 0 : 1;
      const double range = next[axis];
      cell[axis] += sign[axis];
      next[axis] += pace[axis];
      const std::int8_t value = valueAt(cell[0], cell[1]);
      if (value == Occupancy::kFree && range < kLook.range) continue;
      const int way = sign[axis] > 0 ? axis + 2 : axis;
      if (value == Occupancy::kOccupied && range < kLook.range) {
        addSurface(cell[0], cell[1], way, from, key);
      } else {
        key.misses.push_back(range * ray);
      }
      return;
    }
  }

  void addSurface(int x, int y, int way, const Eigen::Vector2d& from, KeyScan& key) {
    const std::size_t face = surfaces_.faceOf(x, y, way);
    if (seen_[face]) return;
    seen_[face] = true;
    faces_.push_back(face);
    const auto known = points_.find(face);
    key.surfaces.points.push_back(
        known != points_.end() ? known->second
                               : points_.emplace(face, surfaces_.at(x, y, way)).first->second);
    auto& point = key.surfaces.points.back();
    point.position -= from;
    point.smoothed -= from;
  }

  std::int8_t valueAt(int x, int y) const {
    if (x < 0 || y < 0 || x >= static_cast<int>(grid_.width) ||
        y >= static_cast<int>(grid_.height)) {
      return Occupancy::kUnknown;
    }
    return grid_.cells[static_cast<std::size_t>(y) * grid_.width + static_cast<std::size_t>(x)];
  }

  const Occupancy& grid_;
  GridSurfaces surfaces_;
  std::vector<bool> seen_;  // by the look that goes on
  std::vector<std::size_t> faces_;
  std::unordered_map<std::size_t, dead_reckoning::SurfacePoint> points_;
};

}  // namespace

GridSurvey surveyGrid(const GridMap& map, double surface) {
  GridSurvey survey;
  survey.cell = map.cells.resolution;
  GridEye eye(map.cells, surface);
  std::set<std::pair<int, int>> looked;
  std::int64_t stamp = 0;
  for (const auto& walk : Lattice(map.cells).walks()) {
    stamp += kLook.apart;
    for (const Eigen::Vector2d& place : walk) {
      const Pose2 pose = map.T_map_grid * Pose2(place, 0.0);
      survey.path.push_back({stamp += kLook.between, pose});
      const auto square = std::make_pair(static_cast<int>(place.x() / kLook.spacing),
                                         static_cast<int>(place.y() / kLook.spacing));
      if (!looked.insert(square).second) continue;
      survey.keys.push_back(eye.look(place));
      survey.poses.push_back(pose);
    }
  }
  if (survey.keys.empty()) {
    throw config::Error(map.path, 0, "image", "its free floor has no room for a robot");
  }
  return survey;
}

}  // namespace sightline::mapping
