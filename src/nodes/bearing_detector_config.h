#pragma once

#include <string>

#include "nodes/estimator_topics.h"
#include "sightline/targets/bearing_detector.h"

namespace sightline::nodes {

/// Parameters of the node bearing_detector.
struct BearingDetectorNodeConfig {
  std::string fixed_frame;
  EstimatorTopics topics;
  targets::BearingDetectorConfig detector;

  void visit(config::FieldVisitor& visitor) {
    visitor.text("fixed_frame", fixed_frame,
                 "a frame in which the world stands still, such as odom; with it the motion of the "
                 "scanner during the sweep is taken out of the bearings; it goes before "
                 "odom_frame");
    detector.visit(visitor);
    topics.visit(visitor);
  }
};

}  // namespace sightline::nodes
