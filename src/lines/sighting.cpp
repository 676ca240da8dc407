#include "sightline/lines/sighting.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace sightline::lines {

namespace {

using geometry::EndKind;
using geometry::FeatureKind;
using geometry::LineSegment;

constexpr struct {
  // Two ends that are one corner: the extractor puts both where the lines cross [m].
  double corner_tolerance = 1e-3;
  // A place vaguer than this is no feature [m].
  double vague = 0.3;
  // Limit of the spacing of beams on a wall that is nearly seen along it [cosine].
  double grazing = 0.05;
} kSightings;

// One end of a segment.
struct End {
  const LineSegment* segment;
  Eigen::Vector2d place;
  double sigma;  // along the line [m]
  EndKind kind;
};

End startOf(const LineSegment& segment) {
  return {&segment, segment.ends.start, segment.start_sigma, segment.start_kind};
}

End endOf(const LineSegment& segment) {
  return {&segment, segment.ends.end, segment.end_sigma, segment.end_kind};
}

// Variance of a line across itself, at a point of it.
double varianceAcross(const geometry::PolarLine& line, const Eigen::Vector2d& point) {
  const Eigen::Vector2d response(1.0, -line.direction().dot(point));
  return response.dot(line.covariance * response);
}

double betweenBeams(const scan::Scan& scan, const End& end) {
  const double range = end.place.norm();
  const double facing =
      std::max(kSightings.grazing, std::abs(end.segment->line.normal().dot(end.place)) / range);
  const double step = range * std::abs(scan.geometry()->angleIncrement()) / facing;
  return step * step / 12.0;
}

Sighting atEdge(const scan::Scan& scan, const End& end) {
  Sighting sighting;
  sighting.kind = end.kind == EndKind::kOccluded ? FeatureKind::kLineEnd : FeatureKind::kEdge;
  sighting.position = end.place;
  sighting.along = end.segment->line.direction();
  const double variance = end.sigma * end.sigma;
  sighting.between_beams = std::min(betweenBeams(scan, end), variance);
  const Eigen::Vector2d normal = end.segment->line.normal();
  sighting.covariance =
      varianceAcross(end.segment->line, end.place) * normal * normal.transpose() +
      (variance - sighting.between_beams) * sighting.along * sighting.along.transpose();
  return sighting;
}

// A corner of which one wall is known: the other end of the corner was put elsewhere.
Sighting atCorner(const End& end) {
  Sighting sighting;
  sighting.position = end.place;
  sighting.along = end.segment->line.direction();
  const Eigen::Vector2d normal = end.segment->line.normal();
  sighting.covariance = varianceAcross(end.segment->line, end.place) * normal * normal.transpose() +
                        end.sigma * end.sigma * sighting.along * sighting.along.transpose();
  return sighting;
}

Sighting atCrossing(const End& a, const End& b) {
  Sighting sighting;
  sighting.position = a.place;
  sighting.along = a.segment->line.direction();
  Eigen::Matrix2d normals;
  normals << a.segment->line.normal().transpose(), b.segment->line.normal().transpose();
  const Eigen::Matrix2d inverse = normals.inverse();
  const Eigen::Vector2d variances(varianceAcross(a.segment->line, a.place),
                                  varianceAcross(b.segment->line, a.place));
  sighting.covariance = inverse * variances.asDiagonal() * inverse.transpose();
  return sighting;
}

std::vector<End> endsOf(const std::vector<LineSegment>& segments) {
  std::vector<End> ends;
  ends.reserve(2 * segments.size());
  for (const LineSegment& segment : segments) {
    ends.push_back(startOf(segment));
    ends.push_back(endOf(segment));
  }
  return ends;
}

const End* otherSideOf(const End& corner, const std::vector<End>& ends) {
  for (const End& end : ends) {
    if (end.segment == corner.segment || end.kind != EndKind::kCorner) continue;
    if ((end.place - corner.place).norm() < kSightings.corner_tolerance) return &end;
  }
  return nullptr;
}

bool isFeature(EndKind kind) {
  return kind != EndKind::kUnknown && kind != EndKind::kScanLimit;
}

std::optional<Sighting> sightingOf(const scan::Scan& scan, const End& end,
                                   const std::vector<End>& ends) {
  if (!isFeature(end.kind)) return std::nullopt;
  if (end.kind != EndKind::kCorner) return atEdge(scan, end);
  const End* const other = otherSideOf(end, ends);
  if (!other) return atCorner(end);
  // Each corner once: by the one of its segments that stands first.
  if (other->segment < end.segment) return std::nullopt;
  return atCrossing(end, *other);
}

Sighting centreOf(const geometry::Arc& arc, std::size_t number) {
  Sighting sighting;
  sighting.kind = FeatureKind::kArc;
  sighting.position = arc.centre;
  sighting.covariance = arc.covariance.topLeftCorner<2, 2>();
  sighting.arc = number;
  return sighting;
}

bool isClear(const Sighting& sighting) {
  const double variance = sighting.fullCovariance().trace();
  return sighting.position.allFinite() && std::isfinite(variance) && variance > 0.0 &&
         variance < kSightings.vague * kSightings.vague;
}

}  // namespace

std::vector<Sighting> sightingsIn(const scan::Scan& scan, const std::vector<LineSegment>& segments,
                                  const std::vector<geometry::Arc>& arcs) {
  std::vector<Sighting> sightings;
  const std::vector<End> ends = endsOf(segments);
  for (const End& end : ends) {
    const auto sighting = sightingOf(scan, end, ends);
    if (sighting && isClear(*sighting)) sightings.push_back(*sighting);
  }
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const Sighting centre = centreOf(arcs[i], i);
    if (isClear(centre)) sightings.push_back(centre);
  }
  return sightings;
}

Sighting operator*(const geometry::Pose2& T_target_source, const Sighting& sighting) {
  const Eigen::Matrix2d R = T_target_source.rotation();
  Sighting moved = sighting;
  moved.position = T_target_source * sighting.position;
  moved.covariance = R * sighting.covariance * R.transpose();
  moved.along = R * sighting.along;
  return moved;
}

}  // namespace sightline::lines
