#include "sightline/bridge/bearing_output.h"

#include <algorithm>
#include <cmath>

#include "sightline/bridge/marker_drawing.h"
#include "sightline/bridge/target_messages.h"

namespace sightline::bridge {

namespace {

// The set as a sensor that hangs upside down has it in its own frame.
void mirrorBearings(targets::BearingSet& set) {
  for (double& bearing : set.bearings) bearing = -bearing;
  set.field_of_view = {-set.field_of_view.max, -set.field_of_view.min};
}

}  // namespace

BearingOutput::BearingOutput(Output& output, const targets::BearingDetectorConfig& config)
    : detector_(config),
      range_min_(config.range_min),
      sets_(output.open<BearingArray>("bearings")),
      markers_(output.open<visualization_msgs::MarkerArray>("bearing_markers")) {}

void BearingOutput::write(const pipeline::LocatedScan& located) {
  targets::BearingSet set = detector_.detect(located.scan);
  if (located.upside_down) mirrorBearings(set);
  ++scans_;
  bearings_ += set.bearings.size();
  empty_ += set.bearings.empty() ? 1 : 0;
  BearingArray message = toMessage(set, located.scan.frame);
  message.range_min = range_min_;
  sets_.write(message);
  if (markers_.is_wanted()) markers_.write(toMarkers(message));
}

visualization_msgs::MarkerArray toMarkers(const BearingArray& message) {
  constexpr double kWidth = 0.03;
  visualization_msgs::MarkerArray markers;
  auto rays =
      emptyMarker("bearings", visualization_msgs::Marker::LINE_LIST, message.header, kWidth);
  rays.color = colour(1.0F, 0.6F, 0.1F, 0.9F);
  // A set without bearings takes the rays of the last one away.
  if (message.bearings.empty()) rays.action = visualization_msgs::Marker::DELETE;
  for (const double bearing : message.bearings) {
    const Eigen::Vector2d direction(std::cos(bearing), std::sin(bearing));
    rays.points.push_back(toPoint(message.range_min * direction, 0.0));
    rays.points.push_back(toPoint(message.range_max * direction, 0.0));
  }
  markers.markers.push_back(rays);
  return markers;
}

}  // namespace sightline::bridge
