#include "polygon_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "polygon_fit.h"
#include "sightline/mapping/side_evidence.h"
#include "visible_outline.h"

namespace sightline::mapping {

namespace {

using geometry::Pose2;

constexpr struct {
  double spacing = 0.9;        // between places that are looked from [m]
  double on_side = 0.15;       // of what is seen from the side that explains it [m]
  double well = 0.7;           // share of what is seen that rooms which are described well explain
  std::size_t asked = 6;       // places of a room that are tried
  double side_cost = 0.8;      // of a side, in metres of wall
  double oblique = 0.14;       // to the sides of a rectangle: furniture is not [rad]
  double least_gain = 1.0;     // of explained wall [m]
  double same_wall = 0.25;     // wall of a rectangle is in a polygon this near to its sides [m]
  double lost_wall = 0.25;     // of the gain, that may be left out
  double lost_floor = 0.2;     // of a rectangle's floor
  double least_overlap = 0.5;  // of a rectangle that gives way
  double least_area = 1.5;     // of a polygon where there was no room [m²]
  double lattice = 0.2;        // for areas [m]
} kPolygons{};

using RoomList = std::vector<RoomOutline>;

/// A place with what is seen from it.
struct View {
  Eigen::Vector2d place;
  double seen = 0.0;       // length of surfaces [m]
  double explained = 0.0;  // on sides of rooms
};

bool isOnSide(const RoomList& rooms, const Eigen::Vector2d& point) {
  return std::any_of(rooms.begin(), rooms.end(), [&](const RoomOutline& room) {
    for (std::size_t i = 0; i < room.sides.size(); ++i) {
      if (room.side(i).distance(point) < kPolygons.on_side) return true;
    }
    return false;
  });
}

// Wall on the sides of a room, and the parts of it that are oblique to those of another, and far
// from all of them [m].
struct Wall {
  double length = 0.0;
  double oblique = 0.0;
  double outside = 0.0;
};

bool isOblique(const SideLine& side, const RoomOutline& other) {
  const double turn = std::remainder(side.angle - other.sides.front().angle, 0.5 * geometry::kPi);
  return std::abs(turn) > kPolygons.oblique;
}

Wall wallOn(const RoomOutline& room, const std::vector<SideEvidence>& evidence,
            const RoomOutline& other) {
  Wall wall;
  for (std::size_t i = 0; i < room.sides.size(); ++i) {
    const geometry::Segment side = room.side(i);
    for (std::size_t bin = 0; bin < evidence[i].bins(); ++bin) {
      if (!evidence[i].isWall(bin)) continue;
      wall.length += SideEvidence::kBin;
      if (isOblique(room.sides[i], other)) wall.oblique += SideEvidence::kBin;
      const double at = (static_cast<double>(bin) + 0.5) * SideEvidence::kBin;
      const Eigen::Vector2d place = side.start + at * side.direction();
      double least = 1e9;
      for (std::size_t j = 0; j < other.sides.size(); ++j)
        least = std::min(least, other.side(j).distance(place));
      if (least > kPolygons.same_wall) wall.outside += SideEvidence::kBin;
    }
  }
  return wall;
}

class PolygonSearch {
 public:
  PolygonSearch(const std::vector<KeyScan>& keys, const std::vector<Pose2>& poses, RoomList& rooms)
      : keys_(keys),
        poses_(poses),
        rooms_(rooms),
        images_(keys, poses, mainDirections(keys, poses).front()) {
    for (const Pose2& pose : poses) {
      const bool is_new = std::none_of(views_.begin(), views_.end(), [&](const View& view) {
        return (view.place - pose.translation()).norm() < kPolygons.spacing;
      });
      if (is_new) views_.push_back({pose.translation()});
    }
  }

  void run() {
    for (View& view : views_) judge(view);
    for (const RoomOutline& room : RoomList(rooms_)) {
      if (isIll(room) && isThere(room)) tryPlaces(placesIn(room));
    }
    for (const View& view : views_) {
      if (!isInRoom(view.place)) tryPlaces({view.place});
    }
  }

 private:
  // Weighs what is seen by its length.
  void judge(View& view) const {
    const auto outline = outlineAbout(images_, view.place, TakenFloor(images_, {}));
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const OutlinePoint& here = outline[i];
      const double step = (outline[(i + 1) % outline.size()].place - here.place).norm();
      if (here.end != LookEnd::kSolid || step > kPolygons.same_wall) continue;
      view.seen += step;
      view.explained += isOnSide(rooms_, here.place) ? step : 0.0;
    }
  }

  std::vector<Eigen::Vector2d> placesIn(const RoomOutline& room) const {
    std::vector<Eigen::Vector2d> places;
    for (const View& view : views_) {
      if (room.contains(view.place)) places.push_back(view.place);
    }
    const std::size_t every = (places.size() + kPolygons.asked - 1) / kPolygons.asked;
    std::vector<Eigen::Vector2d> some;
    for (std::size_t i = 0; i < places.size(); i += std::max<std::size_t>(1, every))
      some.push_back(places[i]);
    return some;
  }

  bool isIll(const RoomOutline& room) const {
    double seen = 0.0;
    double explained = 0.0;
    for (const View& view : views_) {
      if (!room.contains(view.place)) continue;
      seen += view.seen;
      explained += view.explained;
    }
    return explained < kPolygons.well * seen;
  }

  bool isThere(const RoomOutline& room) const {
    return std::any_of(rooms_.begin(), rooms_.end(), [&](const RoomOutline& other) {
      return other.anchor == room.anchor && other.sides.size() == room.sides.size();
    });
  }

  bool isInRoom(const Eigen::Vector2d& place) const {
    return std::any_of(rooms_.begin(), rooms_.end(),
                       [&](const RoomOutline& room) { return room.contains(place); });
  }

  // The polygon about one of the places that is the best by its outline.
  void tryPlaces(const std::vector<Eigen::Vector2d>& places) {
    RoomList firm;
    for (const RoomOutline& room : rooms_) {
      if (!isSquare(room) || !isIll(room)) firm.push_back(room);
    }
    const TakenFloor taken(images_, firm);
    std::optional<RoomOutline> best;
    double most = 0.0;
    for (const Eigen::Vector2d& place : places) {
      auto polygon = polygonAlong(outlineAbout(images_, place, taken));
      if (!polygon || !polygon->contains(place)) continue;
      const double worth =
          polygon->area() - kPolygons.side_cost * static_cast<double>(polygon->sides.size());
      if (best && worth <= most) continue;
      most = worth;
      best = std::move(polygon);
    }
    if (best) propose(*best);
  }

  // Share of one room that lies in another, by floor that was seen.
  double overlap(const RoomOutline& room, const RoomOutline& other) const {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
    Eigen::Vector2d high = -low;
    for (std::size_t i = 0; i < room.sides.size(); ++i) {
      low = low.cwiseMin(room.side(i).start);
      high = high.cwiseMax(room.side(i).start);
    }
    double all = 0.0;
    double both = 0.0;
    for (double x = low.x(); x < high.x(); x += kPolygons.lattice) {
      for (double y = low.y(); y < high.y(); y += kPolygons.lattice) {
        if (!room.contains({x, y}) || !isFree({x, y})) continue;
        all += 1.0;
        both += other.contains({x, y}) ? 1.0 : 0.0;
      }
    }
    return both / std::max(1.0, all);
  }
  bool isFree(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d cells = images_.toImage(place);
    const int x = static_cast<int>(std::floor(cells.x()));
    const int y = static_cast<int>(std::floor(cells.y()));
    return images_.isInside(x, y) && images_.isFree(x, y);
  }

  // Puts a polygon in the place of the rectangles it covers, where that explains more. One that
  // lies in a room which stays is furniture.
  void propose(const RoomOutline& polygon) {
    RoomList left;
    RoomList judged{polygon};
    for (const RoomOutline& room : rooms_) {
      const bool gives_way = isSquare(room) && overlap(room, polygon) > kPolygons.least_overlap;
      if (!gives_way && overlap(polygon, room) > kPolygons.lost_floor) return;
      (gives_way ? judged : left).push_back(room);
    }
    if (!isBetter(judged)) return;
    left.push_back(polygon);
    rooms_ = std::move(left);
  }

  // Whether the first of the rooms describes what the others do, better: by wall that is oblique to
  // theirs, for its further sides.
  bool isBetter(const RoomList& judged) const {
    const RoomOutline& polygon = judged.front();
    const auto evidence = gatherEvidence(keys_, poses_, judged);
    const double cost = kPolygons.side_cost * static_cast<double>(polygon.sides.size());
    if (judged.size() == 1) {
      return polygon.area() > kPolygons.least_area &&
             wallOn(polygon, evidence.front(), polygon).length - cost > kPolygons.least_gain;
    }
    double gain = wallOn(polygon, evidence.front(), judged[1]).oblique - cost;
    double lost = 0.0;
    for (std::size_t r = 1; r < judged.size(); ++r) {
      if (overlap(judged[r], polygon) < 1.0 - kPolygons.lost_floor) return false;
      gain += kPolygons.side_cost * 4.0;
      lost += wallOn(judged[r], evidence[r], polygon).outside;
    }
    return gain > kPolygons.least_gain && lost < kPolygons.lost_wall * gain;
  }

  const std::vector<KeyScan>& keys_;
  const std::vector<Pose2>& poses_;
  RoomList& rooms_;
  FacingImages images_;
  std::vector<View> views_;
};

}  // namespace

void describeByPolygons(const std::vector<KeyScan>& keys, const std::vector<Pose2>& poses,
                        RoomList& rooms) {
  PolygonSearch(keys, poses, rooms).run();
}

}  // namespace sightline::mapping
