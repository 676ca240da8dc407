#pragma once

#include "sightline/config/fields.h"
#include "sightline/pipeline/estimators_config.h"

namespace sightline::nodes {

/// Parameters of every node that estimates: topics of its scans, frames, and how scans are
/// completed.
struct EstimatorTopics {
  pipeline::InputConfig input;
  pipeline::Frames frames;

  void visit(config::FieldVisitor& visitor) {
    visitor.text("odom_frame", frames.odom,
                 "frame of the odometry, in which the world stands still");
    visitor.text("base_frame", frames.base, "frame of the robot");
    input.visit(visitor);
  }
};

}  // namespace sightline::nodes
