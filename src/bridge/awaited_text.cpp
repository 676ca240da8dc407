#include "sightline/bridge/awaited_text.h"

#include <utility>

#include <ros/this_node.h>

#include "sightline/bridge/marker_drawing.h"

namespace sightline::bridge {

namespace {

visualization_msgs::Marker drawing(const std::string& frame, const std::string& text) {
  using visualization_msgs::Marker;
  std_msgs::Header header;  // its stamp of zero is tf's newest
  header.frame_id = frame;
  Marker marker = emptyMarker(ros::this_node::getName(), Marker::TEXT_VIEW_FACING, header, 0.0);
  marker.pose.position = toPoint(Eigen::Vector2d::Zero(), 0.3);
  marker.scale.z = 0.35;
  marker.color = colour(1.0F, 1.0F, 1.0F);
  marker.text = text;
  if (text.empty()) marker.action = Marker::DELETE;
  return marker;
}

}  // namespace

AwaitedText::AwaitedText(ros::NodeHandle node, const std::string& frame, Awaited awaited)
    : frame_(frame),
      awaited_(std::move(awaited)),
      publisher_(node.advertise<visualization_msgs::Marker>("awaited", 1)) {
  timer_ = node.createSteadyTimer(ros::WallDuration(1.0),
                                  [this](const ros::SteadyTimerEvent&) { update(); });
}

void AwaitedText::update() {
  const std::string text = awaited_();
  if (!text.empty() || is_shown_) publisher_.publish(drawing(frame_, text));
  is_shown_ = !text.empty();
}

}  // namespace sightline::bridge
