#include "sightline/bridge/line_markers.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "sightline/bridge/marker_drawing.h"
#include "sightline/geometry/statistics.h"

namespace sightline::bridge {

namespace {

using visualization_msgs::Marker;

constexpr int kBandSteps = 8;
constexpr int kArcSteps = 16;
// Above one another, so that none hides in another's plane.
constexpr double kBandHeight = 0.0;
constexpr double kWallHeight = 0.01;
constexpr double kEndHeight = 0.02;
constexpr double kLabelHeight = 0.1;

std_msgs::ColorRGBA colourOf(geometry::EndKind kind) {
  switch (kind) {
    case geometry::EndKind::kCorner:
      return colour(0.2F, 0.85F, 0.3F, 1.0F);
    case geometry::EndKind::kOccludingEdge:
      return colour(0.25F, 0.5F, 1.0F, 1.0F);
    case geometry::EndKind::kOccluded:
      return colour(1.0F, 0.55F, 0.1F, 1.0F);
    case geometry::EndKind::kScanLimit:
      return colour(0.55F, 0.55F, 0.55F, 1.0F);
    case geometry::EndKind::kUnknown:
      break;
  }
  return colour(1.0F, 1.0F, 1.0F, 1.0F);
}

void addStroke(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height,
               const std_msgs::ColorRGBA& from_colour, const std_msgs::ColorRGBA& to_colour,
               Marker& marker) {
  marker.points.push_back(toPoint(from, height));
  marker.points.push_back(toPoint(to, height));
  marker.colors.push_back(from_colour);
  marker.colors.push_back(to_colour);
}

void addWall(const geometry::LineSegment& segment, Marker& marker) {
  addStroke(segment.ends.start, segment.ends.end, kWallHeight, colourOf(segment.start_kind),
            colourOf(segment.end_kind), marker);
}

// A bar along the line, as long as the end is uncertain.
void addEnds(const geometry::LineSegment& segment, Marker& marker) {
  const Eigen::Vector2d along = segment.ends.direction();
  const auto bar = [&](const Eigen::Vector2d& end, double sigma, geometry::EndKind kind) {
    const Eigen::Vector2d half = geometry::kNormal95 * sigma * along;
    addStroke(end - half, end + half, kEndHeight, colourOf(kind), colourOf(kind), marker);
  };
  bar(segment.ends.start, segment.start_sigma, segment.start_kind);
  bar(segment.ends.end, segment.end_sigma, segment.end_kind);
}

// Half width of the band at a point of the line: a step of the normal's direction moves the line by
// the point's distance from the foot of the normal.
double halfWidth(const geometry::PolarLine& line, const Eigen::Vector2d& point) {
  const Eigen::Vector2d jacobian(1.0, -line.direction().dot(point));
  return geometry::kNormal95 * std::sqrt(std::max(0.0, jacobian.dot(line.covariance * jacobian)));
}

// Two triangles between two rungs of a band.
void addRung(const std::array<geometry_msgs::Point, 2>& before,
             const std::array<geometry_msgs::Point, 2>& here, Marker& marker) {
  for (const auto& corner : {before[0], here[0], here[1], before[0], here[1], before[1]}) {
    marker.points.push_back(corner);
  }
}

void addBand(const geometry::LineSegment& segment, Marker& marker) {
  const Eigen::Vector2d normal = segment.line.normal();
  std::array<geometry_msgs::Point, 2> before;
  for (int i = 0; i <= kBandSteps; ++i) {
    const double share = static_cast<double>(i) / kBandSteps;
    const Eigen::Vector2d point = (1.0 - share) * segment.ends.start + share * segment.ends.end;
    const Eigen::Vector2d half = halfWidth(segment.line, point) * normal;
    const std::array<geometry_msgs::Point, 2> here{toPoint(point - half, kBandHeight),
                                                   toPoint(point + half, kBandHeight)};
    if (i > 0) addRung(before, here, marker);
    before = here;
  }
}

Eigen::Vector2d directionAt(const geometry::Arc& arc, int step) {
  const double share = static_cast<double>(step) / kArcSteps;
  const double angle = (1.0 - share) * arc.start_angle + share * arc.end_angle;
  return {std::cos(angle), std::sin(angle)};
}

void addArc(const geometry::Arc& arc, Marker& marker) {
  for (int i = 0; i < kArcSteps; ++i) {
    for (const int step : {i, i + 1}) {
      const Eigen::Vector2d point = arc.centre + arc.radius * directionAt(arc, step);
      marker.points.push_back(toPoint(point, kWallHeight));
    }
  }
}

// The circle is as uncertain in a direction as its centre and radius are there.
void addArcBand(const geometry::Arc& arc, Marker& marker) {
  std::array<geometry_msgs::Point, 2> before;
  for (int i = 0; i <= kArcSteps; ++i) {
    const Eigen::Vector2d direction = directionAt(arc, i);
    const Eigen::Vector3d jacobian(direction.x(), direction.y(), 1.0);
    const double half =
        geometry::kNormal95 * std::sqrt(std::max(0.0, jacobian.dot(arc.covariance * jacobian)));
    const std::array<geometry_msgs::Point, 2> here{
        toPoint(arc.centre + (arc.radius - half) * direction, kBandHeight),
        toPoint(arc.centre + (arc.radius + half) * direction, kBandHeight)};
    if (i > 0) addRung(before, here, marker);
    before = here;
  }
}

template <class Feature>
double reducedChiSquare(const Feature& feature) {
  return feature.chi_square /
         std::max<double>(1.0, static_cast<double>(feature.degrees_of_freedom));
}

std::vector<LineMarkers::Label> labelsOf(const std::vector<geometry::LineSegment>& segments,
                                         const std::vector<geometry::Arc>& arcs) {
  std::vector<LineMarkers::Label> labels;
  for (const auto& segment : segments) {
    labels.push_back({segment.ends.midpoint(),
                      fmt::format("{:.2f} m, {} beams\nchi2/dof {:.2f}", segment.ends.length(),
                                  segment.beams, reducedChiSquare(segment))});
  }
  for (const auto& arc : arcs) {
    labels.push_back({arc.centre, fmt::format("r {:.3f} m, {} beams\nchi2/dof {:.2f}", arc.radius,
                                              arc.beams, reducedChiSquare(arc))});
  }
  return labels;
}

// rviz has no use for a list without points.
void finish(Marker marker, visualization_msgs::MarkerArray& array) {
  if (marker.points.empty()) marker.action = Marker::DELETE;
  array.markers.push_back(std::move(marker));
}

}  // namespace

void LineMarkersConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("width", width, {"m", {0.001, 1.0}, "width of the drawn segments"});
  visitor.flag("labels", labels, "write beams, length and fit beside each segment");
}

visualization_msgs::MarkerArray LineMarkers::draw(
    const std::vector<geometry::LineSegment>& segments, const std::vector<geometry::Arc>& arcs,
    const std_msgs::Header& header) {
  Marker walls = emptyMarker("segments", Marker::LINE_LIST, header, config_.width);
  Marker ends = emptyMarker("ends", Marker::LINE_LIST, header, 2.0 * config_.width);
  Marker bands = emptyMarker("bands", Marker::TRIANGLE_LIST, header, 1.0);
  bands.scale.z = 1.0;
  Marker rounds = emptyMarker("arcs", Marker::LINE_LIST, header, config_.width);
  rounds.color = colour(0.9F, 0.3F, 0.9F);
  bands.color = colour(1.0F, 0.9F, 0.2F, 0.35F);
  for (const auto& segment : segments) {
    addWall(segment, walls);
    addEnds(segment, ends);
    addBand(segment, bands);
  }
  for (const auto& arc : arcs) {
    addArc(arc, rounds);
    addArcBand(arc, bands);
  }
  visualization_msgs::MarkerArray array;
  for (Marker* marker : {&walls, &ends, &bands, &rounds}) finish(std::move(*marker), array);
  drawLabels(labelsOf(segments, arcs), header, array);
  return array;
}

void LineMarkers::drawLabels(const std::vector<Label>& labels, const std_msgs::Header& header,
                             visualization_msgs::MarkerArray& array) {
  const std::size_t wanted = config_.labels ? labels.size() : 0;
  for (std::size_t i = 0; i < std::max(wanted, labels_shown_); ++i) {
    Marker marker = emptyMarker("labels", Marker::TEXT_VIEW_FACING, header, 0.0);
    marker.id = static_cast<int>(i);
    marker.scale.z = 0.12;
    marker.color = colour(1.0F, 1.0F, 1.0F);
    if (i < wanted) {
      marker.pose.position = toPoint(labels[i].place, kLabelHeight);
      marker.text = labels[i].text;
    } else {
      marker.action = Marker::DELETE;
    }
    array.markers.push_back(std::move(marker));
  }
  labels_shown_ = wanted;
}

}  // namespace sightline::bridge
