#pragma once

#include <string>
#include <vector>

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include "sightline/config/fields.h"
#include "sightline/geometry/arc.h"
#include "sightline/geometry/line_segment.h"

namespace sightline::bridge {

/// Settings of drawn segments.
struct LineMarkersConfig {
  double width = 0.04;  ///< [m]
  bool labels = false;

  void visit(config::FieldVisitor& visitor);
};

/// Draws the segments of one scan: the walls, each end in the colour of its kind (corner green,
/// occluding edge blue, occluded orange, scan limit grey, unknown white), the band in which the
/// line lies with 95 %, the standard deviation of each end along the line, and, if asked for, what
/// each wall is. Arcs are magenta, with a band of their own.
class LineMarkers {
 public:
  struct Label {
    Eigen::Vector2d place;
    std::string text;
  };

  explicit LineMarkers(const LineMarkersConfig& config = {}) : config_(config) {}

  /// One marker for each of those, with the same name and id every time, so that an array replaces
  /// the one before it and leaves nothing of it over.
  visualization_msgs::MarkerArray draw(const std::vector<geometry::LineSegment>& segments,
                                       const std::vector<geometry::Arc>& arcs,
                                       const std_msgs::Header& header);

 private:
  void drawLabels(const std::vector<Label>& labels, const std_msgs::Header& header,
                  visualization_msgs::MarkerArray& array);

  LineMarkersConfig config_;
  std::size_t labels_shown_ = 0;
};

}  // namespace sightline::bridge
