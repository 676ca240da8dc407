#include "sightline/pipeline/body_mask.h"

#include <cmath>

#include "sightline/config/error.h"
#include "sightline/geometry/angle.h"

namespace sightline::pipeline {

namespace {

// Counter-clockwise from one direction to another, in [0, 2π).
double angleFrom(double from, double to) {
  const double angle = std::fmod(to - from, 2.0 * geometry::kPi);
  return angle < 0.0 ? angle + 2.0 * geometry::kPi : angle;
}

bool isIn(const std::vector<double>& sectors, double direction) {
  for (std::size_t i = 0; i + 1 < sectors.size(); i += 2) {
    if (angleFrom(sectors[i], direction) <= angleFrom(sectors[i], sectors[i + 1])) return true;
  }
  return false;
}

}  // namespace

void checkSectors(const BodySectors& sectors) {
  for (const auto& [frame, angles] : sectors) {
    if (angles.size() % 2 == 0) continue;
    throw config::Error("", 0, "body." + frame, "needs pairs of angles: [from, to, from, to]");
  }
}

void maskBody(const std::vector<double>& sectors, const geometry::Pose2& T_base_sensor,
              scan::Scan& scan) {
  for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
    const double direction = T_base_sensor.theta() + scan.geometry()->angles()[beam];
    if (isIn(sectors, direction)) scan.setKind(beam, scan::ReturnKind::kInvalid);
  }
}

}  // namespace sightline::pipeline
