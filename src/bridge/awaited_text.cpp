#include "sightline/bridge/awaited_text.h"

#include <utility>

#include <ros/this_node.h>

#include "sightline/bridge/marker_drawing.h"
#include "sightline/bridge/message_header.h"

namespace sightline::bridge {

namespace {

visualization_msgs::Marker drawing(const std::string& frame, const std::string& text) {
  constexpr double kLetters = 0.35;
  // A stamp of zero is tf's newest.
  auto marker = textMarker(ros::this_node::getName(), text, Eigen::Vector2d::Zero(), kLetters,
                           headerOf(0, frame));
  if (text.empty()) marker.action = visualization_msgs::Marker::DELETE;
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
