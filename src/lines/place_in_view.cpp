#include "sightline/lines/place_in_view.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/angle.h"

namespace sightline::lines {

namespace {

constexpr int kMostTurns = 3;  // of the search for a beam of a sensor that turns

// The beam nearest to a bearing, which may lie outside the field.
double beamAt(const scan::ScanGeometry& geometry, double bearing) {
  const double increment = geometry.angleIncrement();
  if (increment == 0.0) return 0.0;
  const double middle = 0.5 * (geometry.angles().front() + geometry.angles().back());
  const double offset = geometry::wrapAngle(bearing - middle);
  return (middle + offset - geometry.angles().front()) / increment;
}

bool isNearer(const scan::Scan& scan, std::size_t beam, double range) {
  return scan.kinds()[beam] == scan::ReturnKind::kTooNear ||
         (scan.isValid(beam) && scan.ranges()[beam] < range);
}

}  // namespace

PlaceAtBeam beamTowards(const Eigen::Vector2d& place, const scan::Scan& scan) {
  const scan::ScanGeometry& geometry = *scan.geometry();
  const double last = static_cast<double>(geometry.beams() - 1);
  PlaceAtBeam result;
  Eigen::Vector2d seen = place;
  for (int i = 0; i < kMostTurns; ++i) {
    if (!scan.sensorMotion().empty() && i > 0) {
      seen = scan.sensorMotion()[result.beam].inverse() * place;
    }
    result.bearing = std::atan2(seen.y(), seen.x());
    const double beam = beamAt(geometry, result.bearing);
    result.in_field = beam > -0.5 && beam < last + 0.5;
    result.beam = static_cast<std::size_t>(std::llround(std::clamp(beam, 0.0, last)));
  }
  result.range = seen.norm();
  return result;
}

PlaceInView lookAt(const Eigen::Vector2d& place, double spread, const scan::Scan& scan) {
  const PlaceAtBeam towards = beamTowards(place, scan);
  const scan::ScanGeometry& geometry = *scan.geometry();
  const bool in_reach =
      towards.range - spread > geometry.rangeMin() && towards.range + spread < geometry.rangeMax();
  if (!towards.in_field || !in_reach) return PlaceInView::kOutside;
  const double width = spread / towards.range / std::abs(geometry.angleIncrement());
  const auto half = static_cast<std::size_t>(std::clamp(width, 1.0, 1e4));
  const std::size_t first = towards.beam - std::min(half, towards.beam);
  const std::size_t end = std::min(scan.beams(), towards.beam + half + 1);
  // At the rim of the field one side of the place is not seen.
  if (towards.beam < half || towards.beam + half >= scan.beams()) return PlaceInView::kOutside;
  for (std::size_t beam = first; beam < end; ++beam) {
    if (isNearer(scan, beam, towards.range - spread)) return PlaceInView::kHidden;
  }
  return PlaceInView::kSeen;
}

}  // namespace sightline::lines
