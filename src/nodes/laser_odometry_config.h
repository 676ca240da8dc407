#pragma once

#include "nodes/estimator_topics.h"

namespace sightline::nodes {

/// Parameters of the node laser_odometry.
struct LaserOdometryNodeConfig {
  EstimatorTopics topics;
  bool publish_tf = false;
  pipeline::ScanOdometryConfig odometry;

  void visit(config::FieldVisitor& visitor) {
    topics.visit(visitor);
    visitor.flag("publish_tf", publish_tf,
                 "broadcast odom_frame to base_frame; only where nobody else does. The wheels are "
                 "then looked for on the topic alone");
    visitor.group("odometry", odometry);
  }
};

}  // namespace sightline::nodes
