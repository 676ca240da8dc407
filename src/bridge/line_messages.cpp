#include "sightline/bridge/line_messages.h"

#include "sightline/bridge/message_header.h"

namespace sightline::bridge {

namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

geometry_msgs::Point endPoint(const Eigen::Vector2d& point) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  return message;
}

geometry::EndKind endKind(std::uint8_t kind) {
  return kind <= LineSegment::SCAN_LIMIT ? static_cast<geometry::EndKind>(kind)
                                         : geometry::EndKind::kUnknown;
}

}  // namespace

LineSegment toMessage(const geometry::LineSegment& segment) {
  const Eigen::Matrix2d& covariance = segment.line.covariance;
  LineSegment message;
  message.id = segment.id;
  message.rho = segment.line.rho;
  message.phi = segment.line.phi;
  message.covariance = {covariance(0, 0), covariance(0, 1), covariance(1, 0), covariance(1, 1)};
  message.start = endPoint(segment.ends.start);
  message.end = endPoint(segment.ends.end);
  message.start_sigma = segment.start_sigma;
  message.end_sigma = segment.end_sigma;
  message.start_kind = static_cast<std::uint8_t>(segment.start_kind);
  message.end_kind = static_cast<std::uint8_t>(segment.end_kind);
  message.first_beam = static_cast<std::uint32_t>(segment.first_beam);
  message.last_beam = static_cast<std::uint32_t>(segment.last_beam);
  message.beams = static_cast<std::uint32_t>(segment.beams);
  message.chi_square = segment.chi_square;
  message.degrees_of_freedom = static_cast<std::uint32_t>(segment.degrees_of_freedom);
  return message;
}

geometry::LineSegment fromMessage(const LineSegment& message) {
  geometry::LineSegment segment;
  segment.id = message.id;
  segment.line.rho = message.rho;
  segment.line.phi = message.phi;
  segment.line.covariance << message.covariance[0], message.covariance[1], message.covariance[2],
      message.covariance[3];
  segment.ends.start = {message.start.x, message.start.y};
  segment.ends.end = {message.end.x, message.end.y};
  segment.start_sigma = message.start_sigma;
  segment.end_sigma = message.end_sigma;
  segment.start_kind = endKind(message.start_kind);
  segment.end_kind = endKind(message.end_kind);
  segment.first_beam = message.first_beam;
  segment.last_beam = message.last_beam;
  segment.beams = message.beams;
  segment.chi_square = message.chi_square;
  segment.degrees_of_freedom = message.degrees_of_freedom;
  return segment;
}

Arc toMessage(const geometry::Arc& arc) {
  Arc message;
  message.id = arc.id;
  message.centre = endPoint(arc.centre);
  message.radius = arc.radius;
  Eigen::Map<RowMajor3>(message.covariance.data()) = arc.covariance;
  message.start_angle = arc.start_angle;
  message.end_angle = arc.end_angle;
  message.first_beam = static_cast<std::uint32_t>(arc.first_beam);
  message.last_beam = static_cast<std::uint32_t>(arc.last_beam);
  message.beams = static_cast<std::uint32_t>(arc.beams);
  message.chi_square = arc.chi_square;
  message.degrees_of_freedom = static_cast<std::uint32_t>(arc.degrees_of_freedom);
  return message;
}

geometry::Arc fromMessage(const Arc& message) {
  geometry::Arc arc;
  arc.id = message.id;
  arc.centre = {message.centre.x, message.centre.y};
  arc.radius = message.radius;
  arc.covariance = Eigen::Map<const RowMajor3>(message.covariance.data());
  arc.start_angle = message.start_angle;
  arc.end_angle = message.end_angle;
  arc.first_beam = message.first_beam;
  arc.last_beam = message.last_beam;
  arc.beams = message.beams;
  arc.chi_square = message.chi_square;
  arc.degrees_of_freedom = message.degrees_of_freedom;
  return arc;
}

LineSegmentArray toMessage(const std::vector<geometry::LineSegment>& segments,
                           const std::vector<geometry::Arc>& arcs, const scan::Scan& scan) {
  LineSegmentArray message;
  message.header = headerOf(scan.stamp, scan.frame);
  message.segments.reserve(segments.size());
  for (const auto& segment : segments) message.segments.push_back(toMessage(segment));
  message.arcs.reserve(arcs.size());
  for (const auto& arc : arcs) message.arcs.push_back(toMessage(arc));
  return message;
}

std::vector<geometry::LineSegment> fromMessage(const LineSegmentArray& message) {
  std::vector<geometry::LineSegment> segments;
  segments.reserve(message.segments.size());
  for (const auto& segment : message.segments) segments.push_back(fromMessage(segment));
  return segments;
}

}  // namespace sightline::bridge
