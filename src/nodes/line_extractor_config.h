#pragma once

#include <string>

#include "nodes/estimator_topics.h"
#include "sightline/bridge/line_markers.h"

namespace sightline::nodes {

/// Parameters of the node line_extractor.
struct LineExtractorNodeConfig {
  std::string fixed_frame;
  EstimatorTopics topics;
  pipeline::LinesConfig lines;
  lines::FeatureTrackerConfig features;
  bridge::LineMarkersConfig markers;

  void visit(config::FieldVisitor& visitor) {
    visitor.text("fixed_frame", fixed_frame,
                 "a frame in which the world stands still, such as odom; with it the motion of the "
                 "scanner during the sweep is taken from tf and corrected, and features are "
                 "followed over scans; it goes before odom_frame");
    topics.visit(visitor);
    visitor.group("lines", lines);
    visitor.group("features", features);
    visitor.group("markers", markers);
  }
};

}  // namespace sightline::nodes
