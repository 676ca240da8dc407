#pragma once

#include "sightline/pipeline/bearing_topics.h"
#include "sightline/targets/target_tracker_config.h"

namespace sightline::pipeline {

/// Settings of the targets, live and over a recording.
struct TargetsConfig : BearingTopics {
  double period = 0.0;  ///< between two outputs; 0: one a look [s]
  targets::TargetTrackerConfig tracker;

  void visit(config::FieldVisitor& visitor);
};

}  // namespace sightline::pipeline
