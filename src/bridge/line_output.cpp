#include "sightline/bridge/line_output.h"

#include <algorithm>

#include <fmt/format.h>

#include "sightline/bridge/line_messages.h"

namespace sightline::bridge {

namespace {

double ratio(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(whole, 1));
}

template <class Feature>
void mirror(std::vector<Feature>& features) {
  for (Feature& feature : features) feature = geometry::mirrored(feature);
}

}  // namespace

LineOutput::LineOutput(Output& output, const pipeline::InputConfig& input,
                       const LineMarkersConfig& markers)
    : draws_(!output.isBag()) {
  const auto topics = input.topics();
  for (const std::string& topic : topics) {
    const std::string below = topics.size() > 1 ? topic + "/" : "";
    scanners_.push_back({output.open<LineSegmentArray>(below + "lines"), {}, LineMarkers(markers)});
    if (draws_) {
      scanners_.back().markers =
          output.open<visualization_msgs::MarkerArray>(below + "line_markers");
    }
  }
}

void LineOutput::write(const pipeline::Estimates& estimates) {
  if (!estimates.lines) return;
  pipeline::Lines lines = *estimates.lines;
  if (estimates.located.upside_down) {
    mirror(lines.segments);
    mirror(lines.arcs);
  }
  ++scans_;
  segments_ += lines.segments.size();
  arcs_ += lines.arcs.size();
  Scanner& scanner = scanners_[estimates.located.scanner];
  const auto message = toMessage(lines.segments, lines.arcs, estimates.located.scan);
  scanner.lines.write(message);
  if (draws_ && scanner.markers.is_wanted()) {
    scanner.markers.write(scanner.drawing.draw(lines.segments, lines.arcs, message.header));
  }
}

std::vector<std::string> LineOutput::summary() const {
  return {fmt::format("lines: {:.1f} segments and {:.1f} arcs a scan in {} scans",
                      ratio(segments_, scans_), ratio(arcs_, scans_), scans_)};
}

}  // namespace sightline::bridge
