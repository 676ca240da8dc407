#pragma once

#include <vector>

#include <std_msgs/Header.h>

#include "sightline/LineSegmentArray.h"
#include "sightline/geometry/arc.h"
#include "sightline/geometry/line_segment.h"
#include "sightline/scan/scan.h"

namespace sightline::bridge {

LineSegment toMessage(const geometry::LineSegment& segment);
geometry::LineSegment fromMessage(const LineSegment& message);

Arc toMessage(const geometry::Arc& arc);
geometry::Arc fromMessage(const Arc& message);

/// Stamp and frame of the scan.
LineSegmentArray toMessage(const std::vector<geometry::LineSegment>& segments,
                           const std::vector<geometry::Arc>& arcs, const scan::Scan& scan);
std::vector<geometry::LineSegment> fromMessage(const LineSegmentArray& message);

}  // namespace sightline::bridge
