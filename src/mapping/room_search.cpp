#include "room_search.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "sightline/mapping/rectangle_search.h"

namespace sightline::mapping {

namespace {

using geometry::Pose2;

// The search along one direction.
struct Direction {
  FacingImages images;
  RectangleSearch search;

  Direction(const std::vector<KeyScan>& keys, const std::vector<Pose2>& poses, double turn)
      : images(keys, poses, turn), search(images, placesIn(images, poses)) {}

  static std::vector<Eigen::Vector2d> placesIn(const FacingImages& images,
                                               const std::vector<Pose2>& poses) {
    std::vector<Eigen::Vector2d> places;
    for (const Pose2& pose : poses) places.push_back(images.toImage(pose.translation()));
    return places;
  }
};

struct FoundRoom {
  std::size_t direction;
  CellBox box;
};

RoomOutline outlineOf(const FacingImages& images, const CellBox& box) {
  const Eigen::Vector2d low(box.x0, box.y0);
  const Eigen::Vector2d high(box.x1, box.y1);
  return rectangleOutline(images.toMap(0.5 * (low + high)), images.turn(),
                          images.cell() * (high - low));
}

// Whether a box of one search's images holds a place of another's.
std::function<bool(const Eigen::Vector2d&)> holderOf(const FacingImages& images, const CellBox& box,
                                                     const FacingImages& others) {
  return [&images, &others, box](const Eigen::Vector2d& cells) {
    return box.contains(images.toImage(others.toMap(cells)));
  };
}

class RoomSearch {
 public:
  RoomSearch(const std::vector<KeyScan>& keys, const std::vector<Pose2>& poses) {
    for (const double turn : mainDirections(keys, poses))
      directions_.emplace_back(keys, poses, turn);
  }

  std::vector<RoomOutline> find() {
    for (int round = 0; round < RectangleSearch::kRounds; ++round) {
      for (Direction& direction : directions_) direction.search.begin(round);
      while (takeBest()) {
      }
    }
    std::vector<RoomOutline> rooms;
    for (FoundRoom& room : found_) {
      const Direction& direction = directions_[room.direction];
      direction.search.pushOut(room.box);
      rooms.push_back(outlineOf(direction.images, room.box));
    }
    return rooms;
  }

 private:
  // The main direction has the first word where two explain the same.
  bool takeBest() {
    std::optional<std::size_t> best;
    double most = -1e9;
    for (std::size_t d = 0; d < directions_.size(); ++d) {
      const auto score = directions_[d].search.bestScore();
      if (!score || *score <= most) continue;
      most = *score;
      best = d;
    }
    if (!best) return false;
    Direction& winner = directions_[*best];
    const CellBox box = winner.search.takeBest();
    found_.push_back({*best, box});
    for (std::size_t d = 0; d < directions_.size(); ++d) {
      if (d == *best) continue;
      directions_[d].search.giveAway(holderOf(winner.images, box, directions_[d].images));
    }
    return true;
  }

  std::deque<Direction> directions_;  // a search holds its images by reference
  std::vector<FoundRoom> found_;
};

}  // namespace

std::vector<RoomOutline> searchRooms(const std::vector<KeyScan>& keys,
                                     const std::vector<Pose2>& poses) {
  return RoomSearch(keys, poses).find();
}

}  // namespace sightline::mapping
