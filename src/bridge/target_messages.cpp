#include "sightline/bridge/target_messages.h"

#include <algorithm>
#include <cmath>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/marker_drawing.h"
#include "sightline/bridge/message_header.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/geometry/ellipse.h"

namespace sightline::bridge {

targets::BearingSet toBearingSet(const BearingArray& message) {
  if (!(message.range_max > message.range_min))
    throw BadMessage("range_max is not above range_min");
  if (!(message.field_of_view_max > message.field_of_view_min)) {
    throw BadMessage("no field of view: its maximum is not above its minimum");
  }
  if (!(message.standard_deviation >= 0.0)) throw BadMessage("a negative standard deviation");
  targets::BearingSet set;
  set.stamp = nanoseconds(message.header.stamp);
  set.bearings = message.bearings;
  set.field_of_view = {message.field_of_view_min, message.field_of_view_max};
  set.sigma = message.standard_deviation;
  set.range_max = message.range_max;
  return set;
}

BearingArray toMessage(const targets::BearingSet& set, const std::string& frame) {
  BearingArray message;
  message.header = headerOf(set.stamp, frame);
  message.bearings = set.bearings;
  message.standard_deviation = set.sigma;
  message.field_of_view_min = set.field_of_view.min;
  message.field_of_view_max = set.field_of_view.max;
  message.range_max = set.range_max;
  return message;
}

geometry::UncertainPose2 toUncertainPose2(const geometry_msgs::PoseWithCovarianceStamped& message) {
  const auto& pose = message.pose.pose;
  const Eigen::Vector3d position(pose.position.x, pose.position.y, pose.position.z);
  const std::string fault = faultOfPose(position, pose.orientation);
  if (!fault.empty()) throw BadMessage(fault);
  const Eigen::Matrix3d covariance = toCovariance3(message.pose.covariance);
  if (!covariance.allFinite() || covariance.diagonal().minCoeff() < 0.0) {
    throw BadMessage("a pose whose covariance is none");
  }
  return {toPose2(pose), covariance};
}

namespace {

sightline::Target targetMessage(const targets::Target& target) {
  sightline::Target message;
  message.label = target.label;
  message.position = toPoint(target.mean, 0.0);
  for (int i = 0; i < 4; ++i) {
    message.covariance[static_cast<std::size_t>(i)] = target.covariance(i / 2, i % 2);
  }
  message.probability = target.probability;
  message.moving = target.moving;
  return message;
}

// Green where it stands, orange where it moves; paler the less certain it is.
std_msgs::ColorRGBA targetColour(const targets::Target& target) {
  const auto alpha = static_cast<float>(0.3 + 0.6 * target.probability);
  return target.moving > 0.5 ? colour(1.0F, 0.55F, 0.1F, alpha) : colour(0.2F, 0.85F, 0.3F, alpha);
}

visualization_msgs::Marker ellipseMarker(const targets::Target& target,
                                         const std_msgs::Header& header) {
  constexpr double kHeight = 0.02;
  constexpr double kSmallest = 0.3;  // so that a well-known one can still be seen
  auto marker = emptyMarker("targets", visualization_msgs::Marker::CYLINDER, header, kSmallest);
  const geometry::Ellipse ellipse = geometry::covarianceEllipse(target.covariance);
  marker.id = static_cast<int>(target.label);
  marker.pose = toPose({target.mean, ellipse.angle});
  marker.scale.x = std::max(kSmallest, 2.0 * ellipse.major);
  marker.scale.y = std::max(kSmallest, 2.0 * ellipse.minor);
  marker.scale.z = kHeight;
  marker.color = targetColour(target);
  return marker;
}

visualization_msgs::Marker labelMarker(const targets::Target& target,
                                       const std_msgs::Header& header) {
  constexpr double kLetters = 0.6;
  auto marker = textMarker("labels", std::to_string(target.label), target.mean, kLetters, header);
  marker.id = static_cast<int>(target.label);
  return marker;
}

}  // namespace

TargetArray toMessage(const targets::TargetEstimate& estimate, const std::string& frame) {
  TargetArray message;
  message.header = headerOf(estimate.stamp, frame);
  message.expected_number = estimate.expected_number;
  message.number_variance = estimate.number_variance;
  message.expected_undetected = estimate.expected_undetected;
  for (const targets::Target& target : estimate.targets) {
    message.targets.push_back(targetMessage(target));
  }
  return message;
}

visualization_msgs::MarkerArray toMarkers(const targets::TargetEstimate& estimate,
                                          const std::string& frame) {
  const std_msgs::Header header = headerOf(estimate.stamp, frame);
  visualization_msgs::MarkerArray markers;
  visualization_msgs::Marker clear;
  clear.header = header;
  clear.action = visualization_msgs::Marker::DELETEALL;
  markers.markers.push_back(clear);
  for (const targets::Target& target : estimate.targets) {
    markers.markers.push_back(ellipseMarker(target, header));
    markers.markers.push_back(labelMarker(target, header));
  }
  return markers;
}

visualization_msgs::MarkerArray toMarkers(const logs::Points& truth, std::int64_t stamp,
                                          const std::string& frame) {
  constexpr double kSize = 0.12;
  auto marker =
      emptyMarker("truth", visualization_msgs::Marker::SPHERE_LIST, headerOf(stamp, frame), kSize);
  marker.scale.z = kSize;
  marker.color = colour(1.0F, 1.0F, 1.0F);
  for (const Eigen::Vector2d& place : truth) marker.points.push_back(toPoint(place, 0.1));
  visualization_msgs::MarkerArray markers;
  markers.markers.push_back(marker);
  return markers;
}

nav_msgs::OccupancyGrid toMessage(const targets::IntensityGrid& grid, std::int64_t stamp,
                                  const std::string& frame) {
  nav_msgs::OccupancyGrid message;
  message.header = headerOf(stamp, frame);
  message.info.resolution = static_cast<float>(grid.resolution);
  message.info.width = static_cast<std::uint32_t>(grid.width);
  message.info.height = static_cast<std::uint32_t>(grid.height);
  message.info.origin = toPose({grid.origin, 0.0});
  const double area = grid.resolution * grid.resolution;
  for (const double density : grid.cells) {
    message.data.push_back(static_cast<std::int8_t>(std::min(100.0, 100.0 * density * area)));
  }
  return message;
}

}  // namespace sightline::bridge
