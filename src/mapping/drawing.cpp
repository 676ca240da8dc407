#include "sightline/mapping/drawing.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sightline/config/error.h"

namespace sightline::mapping {

namespace {

using Colour = std::array<unsigned char, 3>;

constexpr struct {
  double most_pixels = 2400.0;  // along the longer side
  double finest = 80.0;         // pixels a metre
  double margin = 0.8;          // [m]
  double uncertain = 0.03;      // of a side, across [m]
  double ring = 0.4;            // about a crossing without a door [m]
} kPicture{};

constexpr Colour kPath{150, 200, 150};
constexpr Colour kWall{170, 60, 20};
constexpr Colour kUncertain{0, 140, 255};
constexpr Colour kDoor{60, 160, 0};
constexpr Colour kMissing{0, 0, 220};
constexpr Colour kText{40, 40, 40};
constexpr Colour kFloor{245, 245, 245};
constexpr Colour kSolid{130, 130, 130};

cv::Scalar scalar(const Colour& colour) {
  return {static_cast<double>(colour[0]), static_cast<double>(colour[1]),
          static_cast<double>(colour[2])};
}

class Canvas {
 public:
  Canvas(const Eigen::Vector2d& low, const Eigen::Vector2d& high) : low_(low), high_(high) {
    const Eigen::Vector2d extent = high - low;
    scale_ = std::min(kPicture.finest, kPicture.most_pixels / extent.maxCoeff());
    image_ = cv::Mat(static_cast<int>(extent.y() * scale_) + 1,
                     static_cast<int>(extent.x() * scale_) + 1, CV_8UC3, cv::Scalar(255, 255, 255));
  }
  cv::Point at(const Eigen::Vector2d& p) const {
    return {static_cast<int>(std::floor((p.x() - low_.x()) * scale_)),
            static_cast<int>(std::floor((high_.y() - p.y()) * scale_))};
  }
  void dot(const Eigen::Vector2d& p, double size, const Colour& colour) {
    const cv::Point from = at(p - Eigen::Vector2d(0.5 * size, -0.5 * size));
    const cv::Point to = at(p + Eigen::Vector2d(0.5 * size, -0.5 * size));
    cv::rectangle(image_, from, to, scalar(colour), cv::FILLED);
  }
  void line(const geometry::Segment& segment, int width, const Colour& colour) {
    cv::line(image_, at(segment.start), at(segment.end), scalar(colour), width, cv::LINE_AA);
  }
  void ring(const Eigen::Vector2d& p) {
    cv::circle(image_, at(p), static_cast<int>(kPicture.ring * scale_), scalar(kMissing), 2,
               cv::LINE_AA);
  }
  void text(const Eigen::Vector2d& p, const std::string& words) {
    int baseline = 0;
    const cv::Size size = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, &baseline);
    cv::putText(image_, words, at(p) - cv::Point(size.width / 2, -size.height / 2),
                cv::FONT_HERSHEY_SIMPLEX, 0.45, scalar(kText), 1, cv::LINE_AA);
  }
  void write(const std::string& path) const {
    bool is_written = false;
    try {
      is_written = cv::imwrite(path, image_);
    } catch (const cv::Exception&) {
    }
    if (!is_written) throw config::Error(path, 0, "", "cannot be written");
  }

 private:
  Eigen::Vector2d low_;
  Eigen::Vector2d high_;
  double scale_;
  cv::Mat image_;
};

}  // namespace

void Drawing::hold(const Eigen::Vector2d& point) {
  low_ = low_.cwiseMin(point);
  high_ = high_.cwiseMax(point);
}

void Drawing::addLine(const geometry::Segment& segment, int width, const Colour& colour) {
  hold(segment.start);
  hold(segment.end);
  strokes_.push_back({segment, width, colour});
}

void Drawing::add(const GridMap& grid) {
  const double cell = grid.cells.resolution;
  for (std::size_t y = 0; y < grid.cells.height; ++y) {
    for (std::size_t x = 0; x < grid.cells.width; ++x) {
      const std::int8_t value = grid.cells.cells[y * grid.cells.width + x];
      if (value == world::Occupancy::kUnknown) continue;
      const Eigen::Vector2d place(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      const bool is_free = value == world::Occupancy::kFree;
      dots_.push_back(
          {grid.T_map_grid * Eigen::Vector2d(cell * place), cell, is_free ? kFloor : kSolid});
      if (is_free) hold(dots_.back().place);
    }
  }
}

void Drawing::add(const std::vector<KeyScan>& keys, const std::vector<geometry::Pose2>& poses) {
  for (std::size_t k = 0; k < keys.size(); ++k) {
    for (const auto& point : keys[k].surfaces.points) addPoint(poses[k] * point.position);
  }
}

void Drawing::add(const std::vector<geometry::StampedPose2>& path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    addLine({path[i - 1].pose.translation(), path[i].pose.translation()}, 1, kPath);
  }
}

void Drawing::addSide(const geometry::Segment& side, const std::vector<world::Span>& spans,
                      bool is_certain) {
  const Colour& colour = is_certain ? kWall : kUncertain;
  addLine(side, 1, colour);
  for (const world::Span& span : spans) {
    addLine({side.start + span.from * side.direction(), side.start + span.to * side.direction()}, 3,
            colour);
  }
}

void Drawing::addDoor(const Eigen::Vector2d& centre, double width, const Eigen::Vector2d& along) {
  const Eigen::Vector2d half = 0.5 * width * along;
  addLine({centre - half, centre + half}, 4, kDoor);
}

void Drawing::add(const FittedRooms& fitted) {
  for (const RoomOutline& room : fitted.rooms) {
    for (std::size_t i = 0; i < room.sides.size(); ++i) {
      const bool is_certain = room.sides[i].is_seen && room.sides[i].covariance(0, 0) <
                                                           kPicture.uncertain * kPicture.uncertain;
      addSide(room.side(i), room.spans[i], is_certain);
    }
    labels_.push_back({room.anchor, room.name});
  }
  for (const FittedDoor& door : fitted.doors) {
    addDoor(door.centre_map, door.width,
            fitted.rooms[door.rooms[0]].side(door.sides[0]).direction());
  }
  for (const Crossing& crossing : fitted.missing_doors) {
    rings_.push_back(0.5 * (crossing.left_map + crossing.entered_map));
  }
}

void Drawing::add(const world::RoomMap& map) {
  for (const world::Room& room : map.rooms()) {
    for (const world::Wall& wall : room.walls) {
      const bool is_certain = !wall.sigma || wall.sigma->position < kPicture.uncertain;
      addSide(wall.segment, wall.spans, is_certain && !wall.spans.empty());
    }
    labels_.push_back({outlineOf(room).anchor, room.name});
  }
  for (const world::Door& door : map.doors()) {
    addDoor(door.centre_map, door.width,
            map.wall({door.rooms[0], door.walls[0]}).segment.direction());
  }
}

void Drawing::write(const std::string& path) const {
  const Eigen::Vector2d low = low_.cwiseMin(high_);
  Canvas canvas(low.array() - kPicture.margin, high_.array() + kPicture.margin);
  for (const Dot& dot : dots_) canvas.dot(dot.place, dot.size, dot.colour);
  for (const Stroke& stroke : strokes_) canvas.line(stroke.segment, stroke.width, stroke.colour);
  for (const Eigen::Vector2d& ring : rings_) canvas.ring(ring);
  for (const Label& label : labels_) canvas.text(label.place, label.words);
  canvas.write(path);
}

}  // namespace sightline::mapping
