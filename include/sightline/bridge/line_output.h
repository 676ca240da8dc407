#pragma once

#include <string>
#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "sightline/LineSegmentArray.h"
#include "sightline/bridge/line_markers.h"
#include "sightline/bridge/output.h"
#include "sightline/bridge/shortfall.h"
#include "sightline/pipeline/estimators.h"

namespace sightline::bridge {

/// Lines of each scan on `lines`, in the frame of the scan, and their markers; of several scanners
/// on topics below the scans' names.
class LineOutput {
 public:
  LineOutput(Output& output, const pipeline::InputConfig& input,
             const LineMarkersConfig& markers = {});

  void write(const pipeline::Estimates& estimates);
  /// Summary of all that has been written, a line of text each.
  EstimatorCount counted() const { return {"lines", scans_, {}}; }
  std::vector<std::string> summary() const;

 private:
  struct Scanner {
    Port<LineSegmentArray> lines;
    Port<visualization_msgs::MarkerArray> markers;
    LineMarkers drawing;
  };

  std::vector<Scanner> scanners_;
  bool draws_;
  std::size_t scans_ = 0;
  std::size_t segments_ = 0;
  std::size_t arcs_ = 0;
};

}  // namespace sightline::bridge
