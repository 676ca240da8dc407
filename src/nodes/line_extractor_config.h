#pragma once

#include <string>

#include "sightline/bridge/line_markers.h"
#include "sightline/config/fields.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/scan/noise_model.h"

namespace sightline::nodes {

enum class LineExtractorInput { kScan, kRangeScan };

enum class LineMethod {
  kFull,   ///< lines::LineExtractor
  kPlain,  ///< lines::PlainExtractor
};

/// Parameters of the node line_extractor.
struct LineExtractorNodeConfig {
  LineExtractorInput input = LineExtractorInput::kScan;
  LineMethod method = LineMethod::kFull;
  std::string fixed_frame;
  scan::NoiseModel noise{scan::NoiseKind::kEstimated};
  lines::LineExtractorConfig lines;
  bridge::LineMarkersConfig markers;

  void visit(config::FieldVisitor& visitor) {
    visitor.choice("input", input, {"scan", "range_scan"},
                   "the topic it listens to: scans of any scanner, or those of a sensor that tells "
                   "its variances and how its head turned");
    visitor.choice(
        "method", method, {"full", "plain"},
        "full: each wall once, with arcs; plain: the recursion of pears section 4 alone, "
        "for comparison");
    visitor.text("fixed_frame", fixed_frame,
                 "a frame in which the world stands still, such as odom; with it the motion of the "
                 "scanner during the sweep is taken from tf and corrected");
    visitor.group("noise", noise);
    visitor.group("lines", lines);
    visitor.group("markers", markers);
  }
};

}  // namespace sightline::nodes
