#include "sightline/pipeline/targets_config.h"

namespace sightline::pipeline {

void TargetsConfig::visit(config::FieldVisitor& visitor) {
  BearingTopics::visit(visitor);
  visitor.number("period", period,
                 {"s", {0.0, 1e6}, "time between two outputs; 0: one a look that counts"});
  tracker.visit(visitor);
}

}  // namespace sightline::pipeline
