#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/segment.h"
#include "sightline/geometry/stamped_pose2.h"
#include "sightline/mapping/grid_map.h"
#include "sightline/mapping/room_fitter.h"

namespace sightline::mapping {

/// A picture of rooms over what was seen: walls where they are wall in thick blue, elsewhere thin;
/// sides that are uncertain or were not seen in orange, doors in green, crossings without a door
/// ringed in red, the path in pale green, points in grey. What is added first lies below. The
/// picture shows rooms and paths whole; points beyond them are cut off.
class Drawing {
 public:
  void add(const GridMap& grid);
  /// What a survey met, from the poses of its key scans.
  void add(const std::vector<KeyScan>& keys, const std::vector<geometry::Pose2>& poses);
  void add(const std::vector<geometry::StampedPose2>& path);
  void add(const FittedRooms& fitted);
  void add(const world::RoomMap& map);
  void addPoint(const Eigen::Vector2d& point_map) { dots_.push_back({point_map, 0.0, kPoint}); }

  /// Writes it as a PNG. Throws config::Error where that is not possible.
  void write(const std::string& path) const;

 private:
  using Colour = std::array<unsigned char, 3>;  // blue, green, red
  static constexpr Colour kPoint{190, 190, 190};

  struct Dot {
    Eigen::Vector2d place;
    double size;  // of its square [m]; 0 for a pixel
    Colour colour;
  };
  struct Stroke {
    geometry::Segment segment;
    int width;  // in pixels
    Colour colour;
  };
  struct Label {
    Eigen::Vector2d place;
    std::string words;
  };

  void addSide(const geometry::Segment& side, const std::vector<world::Span>& spans,
               bool is_certain);
  void addDoor(const Eigen::Vector2d& centre, double width, const Eigen::Vector2d& along);
  void addLine(const geometry::Segment& segment, int width, const Colour& colour);
  void hold(const Eigen::Vector2d& point);

  std::vector<Dot> dots_;
  std::vector<Stroke> strokes_;
  std::vector<Eigen::Vector2d> rings_;
  std::vector<Label> labels_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high_ = Eigen::Vector2d::Constant(-1e9);
};

}  // namespace sightline::mapping
