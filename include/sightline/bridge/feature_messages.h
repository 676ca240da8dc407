#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "sightline/FeatureArray.h"
#include "sightline/geometry/feature.h"

namespace sightline::bridge {

/// Features in a frame, as of a stamp [ns].
FeatureArray toMessage(const std::vector<geometry::Feature>& features, const std::string& frame,
                       std::int64_t stamp);
/// Throws BadMessage where a number is not finite, a covariance is none, or a kind is not known.
std::vector<geometry::Feature> fromMessage(const FeatureArray& message);

/// Draws features: the ellipse that holds each with 95 %, and its id; those that are fixed green,
/// sliding orange, moving red, undecided white, and paler where they are not in view.
class FeatureMarkers {
 public:
  /// Markers of features that are gone are taken away.
  visualization_msgs::MarkerArray draw(const std::vector<geometry::Feature>& features,
                                       const std_msgs::Header& header);

 private:
  std::size_t labels_shown_ = 0;
};

}  // namespace sightline::bridge
