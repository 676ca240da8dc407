#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "sightline/mapping/facing_images.h"
#include "sightline/mapping/room_outline.h"

namespace sightline::mapping {

/// What a look from a place ends at: something that stands there, floor that goes on, or what
/// nobody saw.
enum class LookEnd { kSolid, kOpen, kUnseen };

struct OutlinePoint {
  Eigen::Vector2d place;  ///< in the map [m]
  LookEnd end = LookEnd::kUnseen;
  bool opens_after = false;  ///< whether an opening leads from here to the next point
};

/// Cells of images that lie in rooms.
class TakenFloor {
 public:
  TakenFloor(const FacingImages& images, const std::vector<RoomOutline>& rooms);
  bool holds(int x, int y) const {
    return cells_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)] != 0;
  }

 private:
  std::size_t width_;
  std::vector<std::uint8_t> cells_;
};

/// What lies around a place, counter-clockwise: where looks in all directions end, at the border of
/// taken floor at the latest. Things that stand free are left out; what is seen through an opening
/// that is narrow for its depth, as a door or the mouth of a corridor, is replaced by that opening.
std::vector<OutlinePoint> outlineAbout(const FacingImages& images, const Eigen::Vector2d& place_map,
                                       const TakenFloor& taken);

}  // namespace sightline::mapping
