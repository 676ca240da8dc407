#include "sightline/bridge/feature_messages.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sightline/bridge/bad_message.h"
#include "sightline/bridge/marker_drawing.h"
#include "sightline/bridge/message_header.h"
#include "sightline/geometry/angle.h"
#include "sightline/geometry/ellipse.h"

namespace sightline::bridge {

namespace {

using visualization_msgs::Marker;

constexpr int kEllipseSteps = 16;
constexpr double kLeastRadius = 0.03;  // of a drawn ellipse [m]
constexpr double kEllipseHeight = 0.03;
constexpr double kIdHeight = 0.12;

Feature toMessage(const geometry::Feature& feature) {
  const Eigen::Matrix2d& covariance = feature.covariance;
  Feature message;
  message.id = feature.id;
  message.kind = static_cast<std::uint8_t>(feature.kind);
  message.position = toPoint(feature.position, 0.0);
  message.covariance = {covariance(0, 0), covariance(0, 1), covariance(1, 0), covariance(1, 1)};
  message.velocity = {feature.velocity.x(), feature.velocity.y()};
  message.behaviour = static_cast<std::uint8_t>(feature.behaviour);
  message.fixed_probability = feature.fixed_probability;
  message.sliding_probability = feature.sliding_probability;
  message.moving_probability = feature.moving_probability;
  message.age = feature.age;
  message.unseen = feature.unseen;
  message.sightings = feature.sightings;
  return message;
}

geometry::Feature readFeature(const Feature& message) {
  geometry::Feature feature;
  feature.id = message.id;
  feature.kind = static_cast<geometry::FeatureKind>(message.kind);
  feature.position = {message.position.x, message.position.y};
  feature.covariance << message.covariance[0], message.covariance[1], message.covariance[2],
      message.covariance[3];
  feature.velocity = {message.velocity[0], message.velocity[1]};
  feature.behaviour = static_cast<geometry::FeatureBehaviour>(message.behaviour);
  feature.fixed_probability = message.fixed_probability;
  feature.sliding_probability = message.sliding_probability;
  feature.moving_probability = message.moving_probability;
  feature.age = message.age;
  feature.unseen = message.unseen;
  feature.sightings = message.sightings;
  return feature;
}

void requireSound(const Feature& message) {
  if (message.kind < Feature::CORNER || message.kind > Feature::ARC ||
      message.behaviour > Feature::MOVING) {
    throw BadMessage("a feature of a kind or behaviour that is not known");
  }
  const geometry::Feature feature = readFeature(message);
  if (!feature.position.allFinite() || !feature.velocity.allFinite() ||
      !std::isfinite(feature.age + feature.unseen + feature.fixed_probability)) {
    throw BadMessage("a feature with a number that is not finite");
  }
  const Eigen::Matrix2d& C = feature.covariance;
  if (!C.allFinite() || C(0, 0) <= 0.0 || C.determinant() <= 0.0) {
    throw BadMessage("a feature whose covariance is none");
  }
}

std_msgs::ColorRGBA colourOfBehaviour(const geometry::Feature& feature) {
  const float alpha = feature.unseen > 0.0 ? 0.4F : 1.0F;
  switch (feature.behaviour) {
    case geometry::FeatureBehaviour::kFixed:
      return colour(0.2F, 0.85F, 0.3F, alpha);
    case geometry::FeatureBehaviour::kSliding:
      return colour(1.0F, 0.55F, 0.1F, alpha);
    case geometry::FeatureBehaviour::kMoving:
      return colour(1.0F, 0.15F, 0.15F, alpha);
    case geometry::FeatureBehaviour::kUndecided:
      break;
  }
  return colour(1.0F, 1.0F, 1.0F, alpha);
}

Eigen::Vector2d onEllipse(const geometry::Ellipse& ellipse, int step) {
  const double angle = 2.0 * geometry::kPi * step / kEllipseSteps;
  const Eigen::Vector2d along(std::cos(ellipse.angle), std::sin(ellipse.angle));
  const Eigen::Vector2d across(-along.y(), along.x());
  return std::max(kLeastRadius, ellipse.major) * std::cos(angle) * along +
         std::max(kLeastRadius, ellipse.minor) * std::sin(angle) * across;
}

void addFeatureEllipse(const geometry::Feature& feature, Marker& marker) {
  const geometry::Ellipse ellipse = geometry::covarianceEllipse(feature.covariance);
  for (int i = 0; i < kEllipseSteps; ++i) {
    for (const int step : {i, i + 1}) {
      marker.points.push_back(toPoint(feature.position + onEllipse(ellipse, step), kEllipseHeight));
      marker.colors.push_back(colourOfBehaviour(feature));
    }
  }
}

Marker idLabel(const geometry::Feature& feature, const std_msgs::Header& header) {
  Marker marker = emptyMarker("feature_ids", Marker::TEXT_VIEW_FACING, header, 0.0);
  marker.scale.z = 0.1;
  marker.color = colourOfBehaviour(feature);
  marker.pose.position = toPoint(feature.position, kIdHeight);
  marker.text = fmt::format("{}", feature.id);
  return marker;
}

}  // namespace

FeatureArray toMessage(const std::vector<geometry::Feature>& features, const std::string& frame,
                       std::int64_t stamp) {
  FeatureArray message;
  message.header = headerOf(stamp, frame);
  message.features.reserve(features.size());
  for (const auto& feature : features) message.features.push_back(toMessage(feature));
  return message;
}

std::vector<geometry::Feature> fromMessage(const FeatureArray& message) {
  std::vector<geometry::Feature> features;
  features.reserve(message.features.size());
  for (const Feature& feature : message.features) {
    requireSound(feature);
    features.push_back(readFeature(feature));
  }
  return features;
}

visualization_msgs::MarkerArray FeatureMarkers::draw(const std::vector<geometry::Feature>& features,
                                                     const std_msgs::Header& header) {
  visualization_msgs::MarkerArray array;
  Marker ellipses = emptyMarker("features", Marker::LINE_LIST, header, 0.015);
  for (const auto& feature : features) addFeatureEllipse(feature, ellipses);
  if (ellipses.points.empty()) ellipses.action = Marker::DELETE;
  array.markers.push_back(std::move(ellipses));
  for (std::size_t i = 0; i < std::max(features.size(), labels_shown_); ++i) {
    Marker marker = i < features.size()
                        ? idLabel(features[i], header)
                        : emptyMarker("feature_ids", Marker::TEXT_VIEW_FACING, header, 0.0);
    marker.id = static_cast<int>(i);
    if (i >= features.size()) marker.action = Marker::DELETE;
    array.markers.push_back(std::move(marker));
  }
  labels_shown_ = features.size();
  return array;
}

}  // namespace sightline::bridge
