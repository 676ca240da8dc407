// Maps of rooms, spans and doors of any place and size read back as they were written.
#if __has_include(<rapidcheck/gtest.h>)

#include "sightline/world/room_map_file.h"

#include <algorithm>

#include "property.h"

namespace sightline::world {
namespace {

double between(double from, double to) {
  return from + (to - from) * 0.5 * (1.0 + *test::within(1.0));
}

geometry::Pose2 drawPose() {
  return {*test::within(50.0), *test::within(50.0), *test::within(3.2)};
}

// A star-shaped polygon: corners in the order of their bearings.
std::vector<Eigen::Vector2d> drawCorners() {
  const int count = *rc::gen::inRange(3, 9);
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < count; ++i) {
    const double bearing = 2.0 * geometry::kPi * (i + between(0.0, 0.7)) / count;
    corners.push_back(between(1.0, 6.0) * Eigen::Vector2d(std::cos(bearing), std::sin(bearing)));
  }
  return corners;
}

void drawSpans(RoomMap& map, const WallIndex& index) {
  const double length = map.wall(index).segment.length();
  std::vector<double> ends;
  for (int i = *rc::gen::inRange(0, 4); i > 0; --i) {
    ends.push_back(between(0.0, length));
    ends.push_back(between(0.0, length));
  }
  std::sort(ends.begin(), ends.end());
  std::vector<Span> spans;
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    if (ends[i] < ends[i + 1]) spans.push_back({ends[i], ends[i + 1]});
  }
  map.setSpans(index, spans);
}

// A further room whose southern wall faces a wall of the room before it, and a door between them.
void addNeighbour(RoomMap& map, const std::string& name) {
  const std::size_t before = map.rooms().size() - 1;
  const auto count = static_cast<int>(map.rooms()[before].walls.size());
  const auto wall = static_cast<std::size_t>(*rc::gen::inRange(0, count));
  const geometry::Segment side = map.rooms()[before].walls[wall].segment;
  const double depth = between(1.0, 5.0);
  const Eigen::Vector2d outward = -side.leftNormal();
  const geometry::Pose2 pose(side.midpoint() + (0.5 * depth + 0.1) * outward,
                             std::atan2(outward.y(), outward.x()) - 0.5 * geometry::kPi);
  const std::size_t room = map.addRectangle(name, {side.length(), depth}, pose);
  const double place = between(0.0, side.length());
  map.addDoor(before, room, side.start + place * side.direction() + 0.05 * outward,
              between(0.001, side.length()), *rc::gen::arbitrary<bool>());
}

RoomMap drawMap() {
  RoomMap map;
  map.addPolygon(*rc::gen::element<std::string>("hall", "1", "~", "a: b", "yes", ""), drawCorners(),
                 drawPose());
  for (std::size_t i = 0; i < map.rooms()[0].walls.size(); ++i) {
    if (*rc::gen::arbitrary<bool>()) drawSpans(map, {0, i});
  }
  const int neighbours = *rc::gen::inRange(0, 4);
  for (int i = 0; i < neighbours; ++i) addNeighbour(map, "room " + std::to_string(i));
  return map;
}

bool isSame(const Wall& a, const Wall& b) {
  const auto same = [](const Span& left, const Span& right) {
    return left.from == right.from && left.to == right.to;
  };
  return a.name == b.name && a.segment.start == b.segment.start && a.segment.end == b.segment.end &&
         std::equal(a.spans.begin(), a.spans.end(), b.spans.begin(), b.spans.end(), same);
}

RC_GTEST_PROP(RoomMapRoundTrip, ReadsBackAsItWasWritten, ()) {
  const RoomMap map = drawMap();
  const RoomMap read(config::Node::parse(toYaml(map), "written"));
  RC_ASSERT(read.rooms().size() == map.rooms().size());
  for (std::size_t i = 0; i < map.rooms().size(); ++i) {
    const Room& room = map.rooms()[i];
    RC_ASSERT(read.rooms()[i].name == room.name);
    RC_ASSERT(std::equal(room.walls.begin(), room.walls.end(), read.rooms()[i].walls.begin(),
                         read.rooms()[i].walls.end(), isSame));
  }
  RC_ASSERT(read.doors().size() == map.doors().size());
  for (std::size_t i = 0; i < map.doors().size(); ++i) {
    RC_ASSERT(read.doors()[i].centre_map == map.doors()[i].centre_map);
    RC_ASSERT(read.doors()[i].width == map.doors()[i].width);
    RC_ASSERT(read.doors()[i].threshold == map.doors()[i].threshold);
    RC_ASSERT(read.doors()[i].walls[0] == map.doors()[i].walls[0]);
    RC_ASSERT(read.doors()[i].walls[1] == map.doors()[i].walls[1]);
  }
}

}  // namespace
}  // namespace sightline::world

#endif
