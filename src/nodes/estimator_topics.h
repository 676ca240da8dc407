#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "sightline/config/fields.h"
#include "sightline/pipeline/estimators_config.h"

namespace sightline::nodes {

/// What every node that estimates takes as parameters: topics of its scans, frames, and how scans
/// are completed.
struct EstimatorTopics {
  std::string scans;        ///< topics, apart by blanks or commas
  std::string range_scans;  ///< likewise
  pipeline::InputConfig input;
  pipeline::Frames frames;

  void visit(config::FieldVisitor& visitor) {
    visitor.text("scans", scans, "topics of the scanners, apart by blanks; by default scan");
    visitor.text("range_scans", range_scans,
                 "topics of sensors that tell their variances and how their head turned, apart by "
                 "blanks");
    visitor.text("odom_frame", frames.odom,
                 "frame of the odometry, in which the world stands still");
    visitor.text("base_frame", frames.base, "frame of the robot");
    input.visit(visitor);
  }
  /// Puts the topics into the input. To be called once all has been read.
  void finish() {
    input.scans = split(scans);
    input.range_scans = split(range_scans);
  }

 private:
  static std::vector<std::string> split(const std::string& list) {
    std::vector<std::string> topics;
    std::istringstream words(list);
    for (std::string word; words >> word;) topics.push_back(word);
    return topics;
  }
};

}  // namespace sightline::nodes
