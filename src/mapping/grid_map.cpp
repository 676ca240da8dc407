#include "sightline/mapping/grid_map.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "sightline/config/node.h"

namespace sightline::mapping {

namespace {

using config::Node;
using world::Occupancy;

constexpr double kMostCells = 1e8;  // a building of 500 m by 500 m in cells of 5 cm

// What the YAML file says of grey values.
struct Greys {
  bool is_negated;
  double occupied;
  double free;

  explicit Greys(const Node& file)
      : is_negated(file.has("negate") && file.at("negate").integer({0, 1}) == 1),
        occupied(file.at("occupied_thresh").number({0.0, 1.0})),
        free(file.at("free_thresh").number({0.0, 1.0})) {
    const std::string mode = file.textOr("mode", "trinary");
    if (mode != "trinary" && mode != "scale") {
      file.at("mode").fail("is neither 'trinary' nor 'scale'");
    }
    if (free > occupied) file.at("free_thresh").fail("is above 'occupied_thresh'");
  }

  std::int8_t cellOf(int grey) const {
    const double darkness = (is_negated ? grey : 255 - grey) / 255.0;
    if (darkness > occupied) return Occupancy::kOccupied;
    return darkness < free ? Occupancy::kFree : Occupancy::kUnknown;
  }
};

cv::Mat imageOf(const Node& name) {
  cv::Mat image;
  try {
    image = cv::imread(name.path(), cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
  }
  if (image.empty()) name.fail(fmt::format("no image can be read from '{}'", name.path()));
  if (static_cast<double>(image.rows) * image.cols > kMostCells) {
    name.fail(fmt::format("{} x {} cells are too many", image.cols, image.rows));
  }
  return image;
}

// The first row of an image is the uppermost, that of a grid the lowest.
void fill(const cv::Mat& image, const Greys& greys, Occupancy& cells) {
  cells.width = static_cast<std::size_t>(image.cols);
  cells.height = static_cast<std::size_t>(image.rows);
  cells.cells.reserve(cells.width * cells.height);
  for (int row = image.rows; row-- > 0;) {
    for (int x = 0; x < image.cols; ++x) {
      cells.cells.push_back(greys.cellOf(image.at<uchar>(row, x)));
    }
  }
}

void requireKind(const Node& image, const Occupancy& cells, std::int8_t kind, const char* word) {
  const auto& all = cells.cells;
  if (std::find(all.begin(), all.end(), kind) == all.end()) {
    image.fail(fmt::format("no cell of '{}' is {}", image.path(), word));
  }
}

}  // namespace

GridMap readGridMap(const std::string& path) {
  const Node file = Node::readFile(path);
  GridMap map;
  map.path = path;
  map.cells.resolution = file.at("resolution").number({0.005, 1.0});
  map.T_map_grid = file.at("origin").pose(world::kBuildingCoordinates);
  const Greys greys(file);
  const Node image = file.at("image");
  fill(imageOf(image), greys, map.cells);
  requireKind(image, map.cells, Occupancy::kFree, "free");
  requireKind(image, map.cells, Occupancy::kOccupied, "occupied");
  return map;
}

}  // namespace sightline::mapping
