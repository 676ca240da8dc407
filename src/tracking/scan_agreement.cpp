#include "sightline/tracking/scan_agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sightline::tracking {

namespace {

// Distance behind the wall at which a beam ended, along the wall's normal [m].
double excessOf(const scan::Scan& scan, std::size_t beam, const world::Sighting& sighting) {
  if (!scan.isValid(beam)) return std::numeric_limits<double>::infinity();
  return (scan.ranges()[beam] - sighting.range) * sighting.cos_incidence;
}

// Chances of a beam's outcome.
struct BeamModel {
  double hit;
  double stopped;
  double through;

  double logOf(const ScanAgreement& agreement) const {
    return static_cast<double>(agreement.on_wall) * std::log(hit) +
           static_cast<double>(agreement.occluded) * std::log(stopped) +
           static_cast<double>(agreement.beyond) * std::log(through);
  }
};
constexpr double kThrough = 0.02;
constexpr BeamModel kRight{0.79, 0.19, kThrough};
constexpr BeamModel kElsewhere{0.53, 0.19, 0.28};
constexpr double kIndependent = 0.07;  // angle between beams that tell two things [rad]
constexpr double kWideField = 1.5;     // field of view that tells places apart [rad]

double fieldOf(const scan::ScanGeometry& geometry) {
  return std::abs(geometry.angles().back() - geometry.angles().front());
}

}  // namespace

double weightOf(const ScanAgreement& agreement, const scan::ScanGeometry& geometry) {
  const auto beams = static_cast<double>(std::max<std::size_t>(1, agreement.looked_at));
  return std::min(1.0, fieldOf(geometry) / kIndependent / beams);
}

double logLikelihood(const ScanAgreement& agreement, const scan::ScanGeometry& geometry,
                     double usual_hits) {
  const double hit = std::clamp(usual_hits, 0.5, 0.85);
  const BeamModel right{hit, 1.0 - kThrough - hit, kThrough};
  const double stopped = std::max(kElsewhere.stopped, right.stopped);
  const double left = (1.0 - stopped) / (1.0 - kElsewhere.stopped);
  const BeamModel elsewhere{left * kElsewhere.hit, stopped, left * kElsewhere.through};
  return weightOf(agreement, geometry) * (right.logOf(agreement) - elsewhere.logOf(agreement));
}

double logOdds(const ScanAgreement& agreement, const scan::ScanGeometry& geometry) {
  return weightOf(agreement, geometry) * (kRight.logOf(agreement) - kElsewhere.logOf(agreement));
}

bool tellsPlacesApart(const scan::ScanGeometry& geometry) {
  return fieldOf(geometry) >= kWideField;
}

ScanAgreement scanAgreement(const scan::Scan& scan, const geometry::Pose2& T_map_sensor,
                            const world::RoomView& view, double tolerance, std::size_t stride) {
  const Eigen::Matrix2d rotation = T_map_sensor.rotation();
  ScanAgreement agreement;
  for (std::size_t i = 0; i < scan.beams(); i += stride) {
    ++agreement.looked_at;
    const bool nothing = scan.kinds()[i] == scan::ReturnKind::kNothing;
    if (!scan.isValid(i) && !nothing) continue;
    const auto sighting = view.look(rotation * scan.direction(i));
    const bool is_sure = sighting && sighting->is_solid && sighting->margin >= tolerance;
    if (!is_sure || (nothing && sighting->range > scan.geometry()->rangeMax())) {
      if (!nothing) ++agreement.unjudged;
      continue;
    }
    const double excess = excessOf(scan, i, *sighting);
    if (excess > tolerance) {
      ++agreement.beyond;
    } else if (excess < -tolerance) {
      ++agreement.occluded;
    } else {
      ++agreement.on_wall;
    }
  }
  return agreement;
}

}  // namespace sightline::tracking
