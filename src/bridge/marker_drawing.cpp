#include "sightline/bridge/marker_drawing.h"

namespace sightline::bridge {

std_msgs::ColorRGBA colour(float r, float g, float b, float a) {
  std_msgs::ColorRGBA result;
  result.r = r;
  result.g = g;
  result.b = b;
  result.a = a;
  return result;
}

geometry_msgs::Point toPoint(const Eigen::Vector2d& point, double height) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = height;
  return message;
}

visualization_msgs::Marker emptyMarker(const std::string& name, int type,
                                       const std_msgs::Header& header, double width) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.type = type;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = width;
  marker.scale.y = width;
  return marker;
}

visualization_msgs::Marker textMarker(const std::string& name, const std::string& text,
                                      const Eigen::Vector2d& place, double height,
                                      const std_msgs::Header& header) {
  auto marker = emptyMarker(name, visualization_msgs::Marker::TEXT_VIEW_FACING, header, 0.0);
  marker.pose.position = toPoint(place, height);
  marker.scale.z = height;
  marker.color = colour(1.0F, 1.0F, 1.0F);
  marker.text = text;
  return marker;
}

}  // namespace sightline::bridge
