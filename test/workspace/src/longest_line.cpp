// Prints the longest of the lines on /lines, and the room that it lies in: `longest_line
// ROOMS.yaml`.
#include <algorithm>
#include <iostream>

#include <ros/ros.h>
#include <ros/topic.h>
#include <sightline/LineSegmentArray.h>
#include <sightline/geometry/pose2.h>
#include <sightline/world/room_map.h>

namespace {

double length(const sightline::LineSegment& line) {
  return std::hypot(line.end.x - line.start.x, line.end.y - line.start.y);
}

bool shorter(const sightline::LineSegment& a, const sightline::LineSegment& b) {
  return length(a) < length(b);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "longest_line");
  if (argc < 2) return 2;
  const auto map = sightline::world::RoomMap::readFile(argv[1]);
  const auto message =
      ros::topic::waitForMessage<sightline::LineSegmentArray>("lines", ros::Duration(20.0));
  if (!message || message->segments.empty()) return 1;
  const auto longest =
      std::max_element(message->segments.begin(), message->segments.end(), shorter);
  std::cout << length(*longest) << " m, with " << map.rooms().size() << " rooms known\n";
  return 0;
}
