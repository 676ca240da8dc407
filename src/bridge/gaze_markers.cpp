#include "sightline/bridge/gaze_markers.h"

#include <cmath>

#include "sightline/bridge/marker_drawing.h"

namespace sightline::bridge {

namespace {

using visualization_msgs::Marker;

constexpr int kFieldSteps = 12;
constexpr double kFieldHeight = 0.005;

Eigen::Vector2d onField(const gaze::SensorField& field, double range, int step) {
  const double angle = field.half_width * (2.0 * step / kFieldSteps - 1.0);
  return range * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

// The part of the plane that the sensor can measure, as two triangles a step.
Marker fieldMarker(const gaze::SensorField& field, double head_angle,
                   const std_msgs::Header& mount) {
  Marker marker = emptyMarker("field", Marker::TRIANGLE_LIST, mount, 1.0);
  marker.scale.z = 1.0;
  marker.color = colour(0.3F, 0.6F, 1.0F, 0.25F);
  const geometry::Pose2 T_mount_sensor = field.T_mount_sensor(head_angle);
  const auto add = [&](double range, int step) {
    marker.points.push_back(toPoint(T_mount_sensor * onField(field, range, step), kFieldHeight));
  };
  for (int i = 0; i < kFieldSteps; ++i) {
    add(field.range_min, i);
    add(field.range_max, i);
    add(field.range_max, i + 1);
    add(field.range_min, i);
    add(field.range_max, i + 1);
    add(field.range_min, i + 1);
  }
  return marker;
}

Marker targetMarker(const gaze::GazeState& state, const std_msgs::Header& odom,
                    const geometry::Pose2& T_odom_mount) {
  Marker marker = emptyMarker("target", Marker::LINE_LIST, odom, 0.02);
  marker.color = state.is_target_lost ? colour(1.0F, 0.3F, 0.2F) : colour(1.0F, 0.9F, 0.2F);
  if (!state.place) {
    marker.action = Marker::DELETE;
    return marker;
  }
  marker.points.push_back(toPoint(T_odom_mount.translation(), 0.05));
  marker.points.push_back(toPoint(*state.place, 0.05));
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray gazeMarkers(const gaze::GazeControl& gaze, double head_angle,
                                            const std_msgs::Header& mount,
                                            const std::string& odom_frame,
                                            const geometry::Pose2& T_odom_mount) {
  std_msgs::Header odom = mount;
  odom.frame_id = odom_frame;
  visualization_msgs::MarkerArray array;
  array.markers.push_back(fieldMarker(gaze.config().field, head_angle, mount));
  array.markers.push_back(targetMarker(gaze.state(), odom, T_odom_mount));
  return array;
}

}  // namespace sightline::bridge
