#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "sightline/geometry/pose2.h"
#include "sightline/mapping/survey.h"

namespace sightline::mapping {

/// Way that a wall faces in the frame of the images: +x, +y, −x, −y.
constexpr int kFacings = 4;

/// A recording as images of cells, in a frame turned along the walls: where walls were seen that
/// face one of its four ways, what rays passed through, and what nobody saw. Cells lie x first.
class FacingImages {
 public:
  /// @param poses  T_map_base of the key scans
  /// @param turn   of the frame of the images in the map [rad]
  FacingImages(const std::vector<KeyScan>& keys, const std::vector<geometry::Pose2>& poses,
               double turn);

  double cell() const { return cell_; }  ///< [m]
  int width() const { return size_[0]; }
  int height() const { return size_[1]; }
  bool isInside(int x, int y) const { return x >= 0 && y >= 0 && x < size_[0] && y < size_[1]; }

  bool isWall(int facing, int x, int y) const { return walls_[facing][at(x, y)] != 0; }
  /// Whether something stands there, whichever way it faces.
  bool isSolid(int x, int y) const { return solid_[at(x, y)] != 0; }
  /// Whether two rays ended there, however many passed.
  bool isMet(int x, int y) const { return ends_[at(x, y)] > 1; }
  /// Whether rays passed, and nothing stood there.
  bool isFree(int x, int y) const { return free_[at(x, y)] != 0; }
  /// Whether anything is known of it.
  bool isKnown(int x, int y) const { return known_[at(x, y)] != 0; }

  /// Converts a point of the map to cells, and back [m].
  Eigen::Vector2d toImage(const Eigen::Vector2d& point_map) const;
  Eigen::Vector2d toMap(const Eigen::Vector2d& cells) const;
  double turn() const { return turn_; }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(x);
  }
  void findExtent(const std::vector<KeyScan>& keys, const std::vector<geometry::Pose2>& poses);
  void draw(const KeyScan& key, const geometry::Pose2& pose, int number);
  void drawRay(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double end);
  void drawSurface(const dead_reckoning::SurfacePoint& point, const geometry::Pose2& pose,
                   int number);
  void conclude();

  double turn_;
  Eigen::Matrix2d R_image_map_;
  double cell_;
  Eigen::Vector2d origin_;  // of the cells, in the turned frame [m]
  std::array<int, 2> size_{};
  std::array<std::vector<std::uint16_t>, kFacings> hits_;
  std::array<std::vector<int>, kFacings> last_;  // key scan that hit a cell last
  std::vector<std::uint16_t> passes_;
  std::vector<std::uint16_t> ends_;
  std::array<std::vector<std::uint8_t>, kFacings> walls_;
  std::vector<std::uint8_t> solid_;
  std::vector<std::uint8_t> free_;
  std::vector<std::uint8_t> known_;
};

/// Directions of what the scans met, modulo 90°, in [0, 90°) [rad], weighed by length: the main one
/// first, then those of parts of the building that stand at another angle, if any.
std::vector<double> mainDirections(const std::vector<KeyScan>& keys,
                                   const std::vector<geometry::Pose2>& poses);

}  // namespace sightline::mapping
