#include "sightline/mapping/rooms_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sightline/config/error.h"

namespace sightline::mapping {

namespace {

constexpr struct {
  double most_pixels = 2400.0;  // along the longer side
  double finest = 80.0;         // pixels a metre
  double margin = 0.8;          // [m]
  double uncertain = 0.03;      // of a side, across [m]
} kPicture{};

const cv::Scalar kPoint(190, 190, 190);
const cv::Scalar kPath(150, 200, 150);
const cv::Scalar kWall(170, 60, 20);
const cv::Scalar kUncertain(0, 140, 255);
const cv::Scalar kDoor(60, 160, 0);
const cv::Scalar kMissing(0, 0, 220);
const cv::Scalar kText(40, 40, 40);

class Canvas {
 public:
  Canvas(const Eigen::Vector2d& low, const Eigen::Vector2d& high) : low_(low), high_(high) {
    const Eigen::Vector2d extent = high - low;
    scale_ = std::min(kPicture.finest, kPicture.most_pixels / extent.maxCoeff());
    image_ = cv::Mat(static_cast<int>(extent.y() * scale_) + 1,
                     static_cast<int>(extent.x() * scale_) + 1, CV_8UC3, cv::Scalar(255, 255, 255));
  }
  cv::Point at(const Eigen::Vector2d& p) const {
    return {static_cast<int>((p.x() - low_.x()) * scale_),
            static_cast<int>((high_.y() - p.y()) * scale_)};
  }
  void dot(const Eigen::Vector2d& p, const cv::Scalar& colour) {
    const cv::Point here = at(p);
    if (here.x < 0 || here.y < 0 || here.x >= image_.cols || here.y >= image_.rows) return;
    image_.at<cv::Vec3b>(here) =
        cv::Vec3b(static_cast<uchar>(colour[0]), static_cast<uchar>(colour[1]),
                  static_cast<uchar>(colour[2]));
  }
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const cv::Scalar& colour,
            int width) {
    cv::line(image_, at(a), at(b), colour, width, cv::LINE_AA);
  }
  void circle(const Eigen::Vector2d& p, double radius, const cv::Scalar& colour) {
    cv::circle(image_, at(p), static_cast<int>(radius * scale_), colour, 2, cv::LINE_AA);
  }
  void text(const Eigen::Vector2d& p, const std::string& words) {
    int baseline = 0;
    const cv::Size size = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, &baseline);
    cv::putText(image_, words, at(p) - cv::Point(size.width / 2, -size.height / 2),
                cv::FONT_HERSHEY_SIMPLEX, 0.45, kText, 1, cv::LINE_AA);
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

// Path and rooms; what the scans met beyond is cut off.
Canvas canvasFor(const FittedRooms& fitted) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector2d high = -low;
  const auto hold = [&](const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  for (const auto& pose : fitted.poses) hold(pose.pose.translation());
  for (const RoomOutline& room : fitted.rooms) {
    for (std::size_t i = 0; i < room.sides.size(); ++i) hold(room.side(i).start);
  }
  return Canvas(low.array() - kPicture.margin, high.array() + kPicture.margin);
}

void drawRoom(const RoomOutline& room, Canvas& canvas) {
  for (std::size_t i = 0; i < room.sides.size(); ++i) {
    const geometry::Segment side = room.side(i);
    const bool is_certain = room.sides[i].is_seen && room.sides[i].covariance(0, 0) <
                                                         kPicture.uncertain * kPicture.uncertain;
    const cv::Scalar colour = is_certain ? kWall : kUncertain;
    canvas.line(side.start, side.end, colour, 1);
    for (const world::Span& span : room.spans[i]) {
      canvas.line(side.start + span.from * side.direction(),
                  side.start + span.to * side.direction(), colour, 3);
    }
  }
  canvas.text(room.anchor, room.name);
}

void drawDoor(const FittedDoor& door, const std::vector<RoomOutline>& rooms, Canvas& canvas) {
  const Eigen::Vector2d along = rooms[door.rooms[0]].side(door.sides[0]).direction();
  const Eigen::Vector2d half = 0.5 * door.width * along;
  canvas.line(door.centre_map - half, door.centre_map + half, kDoor, 4);
}

}  // namespace

void drawPicture(const Survey& survey, const FittedRooms& fitted, const std::string& path) {
  Canvas canvas = canvasFor(fitted);
  for (std::size_t k = 0; k < survey.keys().size(); ++k) {
    for (const auto& point : survey.keys()[k].surfaces.points) {
      canvas.dot(fitted.path.keys[k] * point.position, kPoint);
    }
  }
  for (std::size_t i = 1; i < fitted.poses.size(); ++i) {
    canvas.line(fitted.poses[i - 1].pose.translation(), fitted.poses[i].pose.translation(), kPath,
                1);
  }
  for (const RoomOutline& room : fitted.rooms) drawRoom(room, canvas);
  for (const FittedDoor& door : fitted.doors) drawDoor(door, fitted.rooms, canvas);
  for (const Crossing& crossing : fitted.missing_doors) {
    canvas.circle(0.5 * (crossing.left_map + crossing.entered_map), 0.4, kMissing);
  }
  canvas.write(path);
}

}  // namespace sightline::mapping
