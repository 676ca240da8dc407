#include "sightline/bridge/line_markers.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace sightline::bridge {

namespace {

using visualization_msgs::Marker;

constexpr double kSigmas95 = 1.959963984540054;
constexpr int kBandSteps = 8;
// Above one another, so that none hides in another's plane.
constexpr double kBandHeight = 0.0;
constexpr double kWallHeight = 0.01;
constexpr double kEndHeight = 0.02;
constexpr double kLabelHeight = 0.1;

std_msgs::ColorRGBA shade(float r, float g, float b, float a) {
  std_msgs::ColorRGBA colour;
  colour.r = r;
  colour.g = g;
  colour.b = b;
  colour.a = a;
  return colour;
}

std_msgs::ColorRGBA shadeOf(geometry::EndKind kind) {
  switch (kind) {
    case geometry::EndKind::kCorner:
      return shade(0.2F, 0.85F, 0.3F, 1.0F);
    case geometry::EndKind::kOccludingEdge:
      return shade(0.25F, 0.5F, 1.0F, 1.0F);
    case geometry::EndKind::kOccluded:
      return shade(1.0F, 0.55F, 0.1F, 1.0F);
    case geometry::EndKind::kScanLimit:
      return shade(0.55F, 0.55F, 0.55F, 1.0F);
    case geometry::EndKind::kUnknown:
      break;
  }
  return shade(1.0F, 1.0F, 1.0F, 1.0F);
}

geometry_msgs::Point raised(const Eigen::Vector2d& point, double height) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = height;
  return message;
}

Marker blank(const char* name, int type, const std_msgs::Header& header) {
  Marker marker;
  marker.header = header;
  marker.ns = name;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

void addStroke(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height,
               const std_msgs::ColorRGBA& from_shade, const std_msgs::ColorRGBA& to_shade,
               Marker& marker) {
  marker.points.push_back(raised(from, height));
  marker.points.push_back(raised(to, height));
  marker.colors.push_back(from_shade);
  marker.colors.push_back(to_shade);
}

void addWall(const geometry::LineSegment& segment, Marker& marker) {
  addStroke(segment.ends.start, segment.ends.end, kWallHeight, shadeOf(segment.start_kind),
            shadeOf(segment.end_kind), marker);
}

// A bar along the line, as long as the end is uncertain.
void addEnds(const geometry::LineSegment& segment, Marker& marker) {
  const Eigen::Vector2d along = segment.ends.direction();
  const auto bar = [&](const Eigen::Vector2d& end, double sigma, geometry::EndKind kind) {
    const Eigen::Vector2d half = kSigmas95 * sigma * along;
    addStroke(end - half, end + half, kEndHeight, shadeOf(kind), shadeOf(kind), marker);
  };
  bar(segment.ends.start, segment.start_sigma, segment.start_kind);
  bar(segment.ends.end, segment.end_sigma, segment.end_kind);
}

// Half width of the band at a point of the line: a step of the normal's direction moves the line by
// the point's distance from the foot of the normal.
double halfWidth(const geometry::PolarLine& line, const Eigen::Vector2d& point) {
  const Eigen::Vector2d jacobian(1.0, -line.direction().dot(point));
  return kSigmas95 * std::sqrt(std::max(0.0, jacobian.dot(line.covariance * jacobian)));
}

void addBand(const geometry::LineSegment& segment, Marker& marker) {
  const Eigen::Vector2d normal = segment.line.normal();
  std::array<geometry_msgs::Point, 2> before;
  for (int i = 0; i <= kBandSteps; ++i) {
    const double share = static_cast<double>(i) / kBandSteps;
    const Eigen::Vector2d point = (1.0 - share) * segment.ends.start + share * segment.ends.end;
    const Eigen::Vector2d half = halfWidth(segment.line, point) * normal;
    const std::array<geometry_msgs::Point, 2> here{raised(point - half, kBandHeight),
                                                   raised(point + half, kBandHeight)};
    if (i > 0) {
      for (const auto& corner : {before[0], here[0], here[1], before[0], here[1], before[1]}) {
        marker.points.push_back(corner);
      }
    }
    before = here;
  }
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
    const std::vector<geometry::LineSegment>& segments, const std_msgs::Header& header) {
  Marker walls = blank("segments", Marker::LINE_LIST, header);
  walls.scale.x = config_.width;
  Marker ends = blank("ends", Marker::LINE_LIST, header);
  ends.scale.x = 2.0 * config_.width;
  Marker bands = blank("bands", Marker::TRIANGLE_LIST, header);
  bands.scale.x = bands.scale.y = bands.scale.z = 1.0;
  bands.color = shade(1.0F, 0.9F, 0.2F, 0.35F);
  for (const auto& segment : segments) {
    addWall(segment, walls);
    addEnds(segment, ends);
    addBand(segment, bands);
  }
  visualization_msgs::MarkerArray array;
  for (Marker* marker : {&walls, &ends, &bands}) finish(std::move(*marker), array);
  drawLabels(segments, header, array);
  return array;
}

void LineMarkers::drawLabels(const std::vector<geometry::LineSegment>& segments,
                             const std_msgs::Header& header,
                             visualization_msgs::MarkerArray& array) {
  const std::size_t wanted = config_.labels ? segments.size() : 0;
  for (std::size_t i = 0; i < std::max(wanted, labels_shown_); ++i) {
    Marker label = blank("labels", Marker::TEXT_VIEW_FACING, header);
    label.id = static_cast<int>(i);
    label.scale.z = 0.12;
    label.color = shade(1.0F, 1.0F, 1.0F, 1.0F);
    if (i < wanted) {
      const geometry::LineSegment& segment = segments[i];
      label.pose.position = raised(segment.ends.midpoint(), kLabelHeight);
      label.text =
          fmt::format("{:.2f} m, {} beams\nchi2/dof {:.2f}", segment.ends.length(), segment.beams,
                      segment.chi_square /
                          std::max<double>(1.0, static_cast<double>(segment.degrees_of_freedom)));
    } else {
      label.action = Marker::DELETE;
    }
    array.markers.push_back(std::move(label));
  }
  labels_shown_ = wanted;
}

}  // namespace sightline::bridge
