#include "sightline/triangulation/calibration_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace sightline::triangulation {

namespace {

std::string rowKey(std::size_t beam) {
  return fmt::format("image_positions[{}]", beam);
}

void checkDepths(const std::vector<double>& depths, const std::string& source) {
  const auto fail = [&](const std::string& reason) {
    throw config::Error(source, 0, "depths", reason);
  };
  if (depths.size() < 2) fail(fmt::format("{} of them, at least 2 are needed", depths.size()));
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const double before = i == 0 ? 0.0 : depths[i - 1];
    if (!(depths[i] > before) || !std::isfinite(depths[i])) {
      fail(fmt::format("{} m does not come after {} m", depths[i], before));
    }
  }
}

void checkRow(const std::vector<double>& positions, const std::vector<double>& depths,
              std::size_t first, std::size_t count, const std::string& source,
              const std::string& key) {
  const auto fail = [&](const std::string& reason) { throw config::Error(source, 0, key, reason); };
  if (positions.size() != depths.size()) {
    fail(fmt::format("{} image positions for {} depths", positions.size(), depths.size()));
  }
  if (count < 2) fail("fewer than two targets were seen");
  for (std::size_t i = first; i < first + count; ++i) {
    if (!std::isfinite(positions[i])) fail(fmt::format("a gap at a depth of {} m", depths[i]));
    if (i > first && !(positions[i] < positions[i - 1])) {
      fail(fmt::format("the image position does not fall from {} m to {} m", depths[i - 1],
                       depths[i]));
    }
  }
}

std::vector<std::vector<double>> readRows(const config::Node& node) {
  std::vector<std::vector<double>> rows;
  for (const config::Node& row : node.items()) {
    rows.emplace_back();
    for (const config::Node& value : row.items()) {
      rows.back().push_back(value.text() == ".nan" ? std::numeric_limits<double>::quiet_NaN()
                                                   : value.number());
    }
  }
  return rows;
}

}  // namespace

CalibrationTable::Row CalibrationTable::rowOf(const std::vector<double>& image_positions) {
  const auto seen = [](double p) { return !std::isnan(p); };
  const auto first = std::find_if(image_positions.begin(), image_positions.end(), seen);
  const auto end = std::find_if(image_positions.rbegin(), image_positions.rend(), seen).base();
  Row row;
  row.first = static_cast<std::size_t>(first - image_positions.begin());
  for (auto p = first; p < end; ++p) row.negated.push_back(-*p);
  return row;
}

CalibrationTable::CalibrationTable(std::vector<double> depths,
                                   std::vector<std::vector<double>> image_positions,
                                   const std::string& source)
    : depths_(std::move(depths)) {
  checkDepths(depths_, source);
  if (image_positions.empty()) throw config::Error(source, 0, "image_positions", "is empty");
  for (std::size_t beam = 0; beam < image_positions.size(); ++beam) {
    rows_.push_back(rowOf(image_positions[beam]));
    checkRow(image_positions[beam], depths_, rows_.back().first, rows_.back().negated.size(),
             source, rowKey(beam));
  }
  for (const double depth : depths_) inverse_depths_.push_back(1.0 / depth);
}

CalibrationTable::CalibrationTable(const config::Node& node) : CalibrationTable(fromNode(node)) {}

CalibrationTable CalibrationTable::fromNode(const config::Node& node) {
  node.allowOnly({"depths", "image_positions"});
  const config::Node rows = node.at("image_positions");
  try {
    return {node.at("depths").numbers(), readRows(rows), ""};
  } catch (const config::Error& error) {
    if (!error.source().empty()) throw;  // names its place already
    const std::vector<config::Node> items = rows.items();
    for (std::size_t beam = 0; beam < items.size(); ++beam) {
      if (error.key() == rowKey(beam)) items[beam].fail(error.reason());
    }
    node.at(error.key()).fail(error.reason());
  }
}

std::vector<double> CalibrationTable::imagePositions(std::size_t beam) const {
  std::vector<double> positions(depths_.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < rows_[beam].negated.size(); ++i) {
    positions[rows_[beam].first + i] = -rows_[beam].negated[i];
  }
  return positions;
}

CalibrationTable::Lookup CalibrationTable::lookUp(std::size_t beam, double image_position) const {
  const Row& row = rows_[beam];
  const double wanted = -image_position;
  Reach reach = Reach::kWithin;
  if (wanted < row.negated.front()) reach = Reach::kNearer;
  if (wanted > row.negated.back()) reach = Reach::kFarther;
  // The interval at an end serves for what is beyond it, too.
  const auto above = std::lower_bound(row.negated.begin() + 1, row.negated.end() - 1, wanted);
  const auto i = static_cast<std::size_t>(above - row.negated.begin());
  const double slope = (inverse_depths_[row.first + i] - inverse_depths_[row.first + i - 1]) /
                       (row.negated[i] - row.negated[i - 1]);
  const double p = std::clamp(wanted, row.negated.front(), row.negated.back());
  const double depth = 1.0 / (inverse_depths_[row.first + i] + slope * (p - row.negated[i]));
  return {reach, depth, slope * depth * depth};
}

}  // namespace sightline::triangulation
