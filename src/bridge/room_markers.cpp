#include "sightline/bridge/room_markers.h"

#include <cmath>

#include <Eigen/Geometry>

#include "sightline/bridge/marker_drawing.h"
#include "sightline/bridge/message_header.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/geometry/ellipse.h"

namespace sightline::bridge {

namespace {

using visualization_msgs::Marker;

constexpr float kWallWidth = 0.06F;

constexpr char kTextName[] = "room";
constexpr double kTextHeight = 0.35;  // [m]

// Adds the stretches where walls stand; those of the room `current` are bright.
void addWalls(const world::RoomMap& map, const std::string& current, Marker& marker) {
  for (const world::Room& room : map.rooms()) {
    const auto shade =
        room.name == current ? colour(1.0F, 0.75F, 0.1F) : colour(0.55F, 0.55F, 0.6F, 0.8F);
    for (const world::Wall& wall : room.walls) {
      for (const world::Span& span : wall.spans) {
        const Eigen::Vector2d along = wall.segment.direction();
        marker.points.push_back(toPoint(wall.segment.start + span.from * along, 0.0));
        marker.points.push_back(toPoint(wall.segment.start + span.to * along, 0.0));
        marker.colors.insert(marker.colors.end(), 2, shade);
      }
    }
  }
}

// Everything that one array of markers is drawn from.
struct Scene {
  const tracking::TrackerUpdate& update;
  const world::RoomMap& map;
  std_msgs::Header header;

  Marker marker(const std::string& name, int type, double width) const {
    return emptyMarker(name, type, header, width);
  }
};

Marker walls(const Scene& scene) {
  Marker marker = scene.marker("walls", Marker::LINE_LIST, kWallWidth);
  addWalls(scene.map, scene.update.room, marker);
  return marker;
}

// A gate is drawn over the length of its wall, as the two edges of jensfelt fig. 4.
void addGate(const Scene& scene, const tracking::WallUpdate& found, Marker& marker) {
  const geometry::Segment& segment = scene.map.rooms()[found.room].walls[found.wall].segment;
  const Eigen::Vector2d normal = segment.leftNormal();
  const double foot = segment.along(scene.update.pose.mean.translation());
  const auto edge = [&](double along, double side) {
    const double half = found.gate.opening + std::abs(along - foot) * std::tan(found.gate.angle);
    return toPoint(segment.start + along * segment.direction() + side * half * normal, 0.02);
  };
  const double waist = std::min(std::max(foot, 0.0), segment.length());
  for (const double side : {-1.0, 1.0}) {
    for (const double end : {0.0, segment.length()}) {
      marker.points.push_back(edge(waist, side));
      marker.points.push_back(edge(end, side));
    }
  }
}

Marker gates(const Scene& scene) {
  Marker marker = scene.marker("gates", Marker::LINE_LIST, 0.02);
  marker.color = colour(0.3F, 0.8F, 1.0F, 0.8F);
  for (const auto& wall : scene.update.walls) {
    if (wall.beams_in_gate > 0) addGate(scene, wall, marker);
  }
  return marker;
}

Marker acceptedPoints(const Scene& scene, const scan::Scan& scan,
                      const geometry::Pose2& T_base_sensor) {
  Marker marker = scene.marker("accepted", Marker::POINTS, 0.07);
  marker.color = colour(0.2F, 1.0F, 0.3F);
  const geometry::Pose2 T_map_sensor = scene.update.pose.mean * T_base_sensor;
  for (const auto& wall : scene.update.walls) {
    if (!wall.accepted()) continue;
    for (const std::size_t beam : wall.fit->accepted_beams) {
      marker.points.push_back(toPoint(T_map_sensor * scan.point(beam), 0.05));
    }
  }
  return marker;
}

Marker positionEllipse(const Scene& scene) {
  const geometry::Ellipse ellipse =
      geometry::covarianceEllipse(scene.update.pose.covariance.topLeftCorner<2, 2>());
  // Thinner than this, rviz draws nothing.
  constexpr double kThinnest = 0.02;
  Marker marker = scene.marker("position 95 %", Marker::CYLINDER, 0.0);
  marker.pose = toPose({scene.update.pose.mean.translation(), ellipse.angle});
  marker.scale.x = std::max(2.0 * ellipse.major, kThinnest);
  marker.scale.y = std::max(2.0 * ellipse.minor, kThinnest);
  marker.scale.z = 0.01;
  marker.color = colour(1.0F, 0.2F, 0.8F, 0.6F);
  return marker;
}

// Other poses that are held possible, the fainter the less probable: their place and heading.
Marker rivals(const Scene& scene) {
  constexpr double kLength = 0.5;  // [m]
  Marker marker = scene.marker("rivals", Marker::LINE_LIST, 0.05);
  for (const tracking::RivalPose& rival : scene.update.rivals) {
    const Eigen::Vector2d tip = rival.pose.mean * Eigen::Vector2d(kLength, 0.0);
    for (const double side : {-0.4, 0.0, 0.4}) {
      const Eigen::Vector2d tail(side == 0.0 ? 0.0 : 0.6 * kLength, side * kLength);
      marker.points.push_back(toPoint(rival.pose.mean * tail, 0.06));
      marker.points.push_back(toPoint(tip, 0.06));
    }
    const auto opacity = static_cast<float>(0.2 + 0.6 * rival.probability);
    marker.colors.insert(marker.colors.end(), 6, colour(1.0F, 0.5F, 0.9F, opacity));
  }
  return marker;
}

Marker roomName(const Scene& scene) {
  const Eigen::Vector2d above = scene.update.pose.mean.translation() + Eigen::Vector2d(0.0, 0.6);
  return textMarker(kTextName, scene.update.room, above, kTextHeight, scene.header);
}

// Where a view of the map begins: at its origin, unless that is outside.
Eigen::Vector2d firstSeen(const world::RoomMap& map) {
  Eigen::AlignedBox2d box;
  for (const world::Room& room : map.rooms()) {
    for (const world::Wall& wall : room.walls) box.extend(wall.segment.start);
  }
  const Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  return box.contains(origin) ? origin : Eigen::Vector2d(box.center());
}

// A shape without points is an error to rviz: it is taken away instead.
void removeIfEmpty(Marker& marker) {
  const bool needs_points = marker.type == Marker::LINE_LIST || marker.type == Marker::POINTS;
  if (needs_points && marker.points.empty()) marker.action = Marker::DELETE;
}

}  // namespace

visualization_msgs::MarkerArray roomMarkers(const tracking::TrackerUpdate& update,
                                            const world::RoomMap& map, const scan::Scan& scan,
                                            const geometry::Pose2& T_base_sensor,
                                            const std::string& map_frame) {
  Scene scene{update, map, {}};
  scene.header = headerOf(update.stamp, map_frame);
  visualization_msgs::MarkerArray array;
  array.markers = {
      walls(scene),           gates(scene),  acceptedPoints(scene, scan, T_base_sensor),
      positionEllipse(scene), rivals(scene), roomName(scene)};
  for (Marker& marker : array.markers) removeIfEmpty(marker);
  return array;
}

visualization_msgs::MarkerArray awaitingMarkers(const world::RoomMap& map, const std::string& text,
                                                const std::string& map_frame) {
  const std_msgs::Header header = headerOf(0, map_frame);  // tf's newest
  Marker walls = emptyMarker("walls", Marker::LINE_LIST, header, kWallWidth);
  addWalls(map, "", walls);
  visualization_msgs::MarkerArray array;
  array.markers = {walls, textMarker(kTextName, text, firstSeen(map), kTextHeight, header)};
  for (const char* of_a_pose : {"gates", "accepted", "position 95 %", "rivals"}) {
    array.markers.push_back(emptyMarker(of_a_pose, Marker::LINE_LIST, header, 0.0));
    array.markers.back().action = Marker::DELETE;
  }
  return array;
}

}  // namespace sightline::bridge
