#include "sightline/bridge/search_messages.h"

#include "sightline/bridge/marker_drawing.h"
#include "sightline/bridge/message_header.h"
#include "sightline/bridge/pose_conversion.h"

namespace sightline::bridge {

nav_msgs::Path toMessage(const targets::SearchAction& action, std::int64_t stamp,
                         const std::string& frame) {
  nav_msgs::Path path;
  path.header = headerOf(stamp, frame);
  for (const geometry::Pose2& pose : action.poses) {
    geometry_msgs::PoseStamped stamped;
    stamped.header = path.header;
    stamped.pose = toPose(pose);
    path.poses.push_back(stamped);
  }
  return path;
}

visualization_msgs::MarkerArray toMarkers(const std::vector<targets::SearchAction>& actions,
                                          std::int64_t stamp, const std::string& frame) {
  constexpr double kCircle = 0.25;
  constexpr double kLine = 0.05;
  const std_msgs::Header header = headerOf(stamp, frame);
  auto looks = emptyMarker("looks", visualization_msgs::Marker::SPHERE_LIST, header, kCircle);
  auto ways = emptyMarker("ways", visualization_msgs::Marker::LINE_LIST, header, kLine);
  looks.scale.z = kCircle;
  looks.color = ways.color = colour(0.35F, 0.65F, 1.0F, 0.9F);
  for (const targets::SearchAction& action : actions) {
    for (std::size_t i = 0; i < action.poses.size(); ++i) {
      looks.points.push_back(toPoint(action.poses[i].translation(), 0.0));
      if (i == 0) continue;
      ways.points.push_back(toPoint(action.poses[i - 1].translation(), 0.0));
      ways.points.push_back(toPoint(action.poses[i].translation(), 0.0));
    }
  }
  visualization_msgs::MarkerArray markers;
  for (auto* marker : {&looks, &ways}) {
    if (marker->points.empty()) marker->action = visualization_msgs::Marker::DELETE;
    markers.markers.push_back(*marker);
  }
  return markers;
}

}  // namespace sightline::bridge
