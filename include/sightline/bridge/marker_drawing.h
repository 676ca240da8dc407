#pragma once

#include <string>

#include <geometry_msgs/Point.h>
#include <std_msgs/ColorRGBA.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/Marker.h>
#include <Eigen/Core>

namespace sightline::bridge {

std_msgs::ColorRGBA colour(float r, float g, float b, float a = 1.0F);
/// [m]
geometry_msgs::Point toPoint(const Eigen::Vector2d& point, double height);
/// A marker that adds its shape to the picture, in the frame and at the stamp of the header; its
/// lines are `width` wide [m].
visualization_msgs::Marker emptyMarker(const std::string& name, int type,
                                       const std_msgs::Header& header, double width);

/// White text that faces the viewer, its letters `height` high [m], as far above a place.
visualization_msgs::Marker textMarker(const std::string& name, const std::string& text,
                                      const Eigen::Vector2d& place, double height,
                                      const std_msgs::Header& header);

}  // namespace sightline::bridge
