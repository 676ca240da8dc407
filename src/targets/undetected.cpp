#include "sightline/targets/undetected.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sightline/config/error.h"

namespace sightline::targets {

void UndetectedConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("prior", prior, {"1/m^2", {0.0, 1e6}, "density of targets before any look"});
  visitor.number("floor", floor,
                 {"1/m^2",
                  {0.0, 1e6},
                  "density that looks never go below, as misses in a row are not independent"});
  visitor.number("resolution", resolution, {"m", {0.05, 10.0}, "cells of the grid"});
  visitor.numbers("area", area,
                  {"m", config::kCoordinate,
                   "x_min, y_min, x_max, y_max of the place outside which there are no targets; "
                   "without: anywhere"});
}

void UndetectedConfig::check(const std::string& source) const {
  if (area.empty()) return;
  if (area.size() == 4 && area[0] < area[2] && area[1] < area[3]) return;
  throw config::Error(source, 0, "undetected.area", "expected x_min, y_min, x_max, y_max");
}

Undetected::Undetected(const UndetectedConfig& config) : config_(config) {
  grid_.resolution = config.resolution;
}

bool Undetected::isInside(const Eigen::Vector2d& point_map) const {
  const auto& area = config_.area;
  if (area.empty()) return true;
  return point_map.x() >= area[0] && point_map.y() >= area[1] && point_map.x() <= area[2] &&
         point_map.y() <= area[3];
}

double Undetected::priorAt(const Eigen::Vector2d& point_map) const {
  return isInside(point_map) ? config_.prior : 0.0;
}

Eigen::Vector2d Undetected::centreOf(std::size_t column, std::size_t row) const {
  return grid_.origin + grid_.resolution * Eigen::Vector2d(static_cast<double>(column) + 0.5,
                                                           static_cast<double>(row) + 0.5);
}

std::optional<std::size_t> Undetected::cellOf(const Eigen::Vector2d& point_map) const {
  const Eigen::Vector2d cell = (point_map - grid_.origin) / grid_.resolution;
  if (!(cell.x() >= 0.0 && cell.y() >= 0.0)) return std::nullopt;
  const auto column = static_cast<std::size_t>(cell.x());
  const auto row = static_cast<std::size_t>(cell.y());
  if (column >= grid_.width || row >= grid_.height) return std::nullopt;
  return row * grid_.width + column;
}

double Undetected::at(const Eigen::Vector2d& point_map) const {
  const auto cell = cellOf(point_map);
  return cell ? grid_.cells[*cell] : priorAt(point_map);
}

// Grows in steps of several cells, so that it seldom has to.
void Undetected::cover(const Eigen::Vector2d& centre_map, double radius) {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius);
  const Eigen::Vector2d size =
      grid_.resolution *
      Eigen::Vector2d(static_cast<double>(grid_.width), static_cast<double>(grid_.height));
  const Eigen::Vector2d low = centre_map - reach;
  const Eigen::Vector2d high = centre_map + reach;
  const bool is_covered = grid_.width > 0 && (low.array() >= grid_.origin.array()).all() &&
                          (high.array() <= (grid_.origin + size).array()).all();
  if (is_covered) return;
  const bool is_new = grid_.width == 0;
  reshape(is_new ? low : low.cwiseMin(grid_.origin),
          is_new ? high : high.cwiseMax(grid_.origin + size));
}

void Undetected::reshape(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  constexpr double kBlock = 16.0;
  const double block = kBlock * grid_.resolution;
  const Undetected before = *this;
  const Eigen::Vector2d first = (low / block).array().floor();
  const Eigen::Vector2d last = (high / block).array().ceil();
  grid_.origin = block * first;
  grid_.width = static_cast<std::size_t>(kBlock * (last.x() - first.x()));
  grid_.height = static_cast<std::size_t>(kBlock * (last.y() - first.y()));
  grid_.cells.resize(grid_.width * grid_.height);
  for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
    grid_.cells[i] = before.at(centreOf(i % grid_.width, i / grid_.width));
  }
}

namespace {

std::size_t cellFloor(double cells, std::size_t count) {
  return static_cast<std::size_t>(std::clamp(std::floor(cells), 0.0, static_cast<double>(count)));
}

}  // namespace

Undetected::Span Undetected::columnsWithin(double low, double high) const {
  return {cellFloor((low - grid_.origin.x()) / grid_.resolution, grid_.width),
          cellFloor((high - grid_.origin.x()) / grid_.resolution + 1.0, grid_.width)};
}

Undetected::Span Undetected::rowsWithin(double low, double high) const {
  return {cellFloor((low - grid_.origin.y()) / grid_.resolution, grid_.height),
          cellFloor((high - grid_.origin.y()) / grid_.resolution + 1.0, grid_.height)};
}

void Undetected::look(const geometry::Pose2& T_map_sensor, const SensorModel& model,
                      const FieldOfView& field_of_view) {
  const double reach = model.config().detection.range_max;
  const Eigen::Vector2d sensor = T_map_sensor.translation();
  cover(sensor, reach);
  const geometry::Pose2 T_sensor_map = T_map_sensor.inverse();
  const Span rows = rowsWithin(sensor.y() - reach, sensor.y() + reach);
  const Span columns = columnsWithin(sensor.x() - reach, sensor.x() + reach);
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    for (std::size_t column = columns.first; column < columns.end; ++column) {
      double& cell = grid_.cells[row * grid_.width + column];
      if (cell <= config_.floor) continue;
      const Eigen::Vector2d centre = centreOf(column, row);
      if ((centre - sensor).squaredNorm() > reach * reach) continue;
      const Polar place = polarOf(T_sensor_map * centre);
      if (!field_of_view.contains(place.bearing) || !model.isInSight(centre, T_map_sensor))
        continue;
      cell = std::max(config_.floor, cell * (1.0 - model.detection(place)));
    }
  }
}

void Undetected::add(const Eigen::Vector2d& point_map, double mass) {
  const auto cell = cellOf(point_map);
  if (cell && isInside(point_map)) {
    grid_.cells[*cell] += mass / (grid_.resolution * grid_.resolution);
  }
}

double Undetected::mass() const {
  return std::accumulate(grid_.cells.begin(), grid_.cells.end(), 0.0) * grid_.resolution *
         grid_.resolution;
}

}  // namespace sightline::targets
