#include "sightline/tracking/scan_agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

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

  double logOf(double hits, const ScanAgreement& agreement) const {
    return hits * std::log(hit) + static_cast<double>(agreement.occluded) * std::log(stopped) +
           static_cast<double>(agreement.beyond) * std::log(through);
  }
};
constexpr double kThrough = 0.02;
constexpr BeamModel kRight{0.79, 0.19, kThrough};
constexpr BeamModel kElsewhere{0.53, 0.19, 0.28};
constexpr double kIndependent = 0.07;  // angle between beams that tell two things [rad]
constexpr double kWideField = 1.5;     // field of view that tells places apart [rad]
// Independent beams on one wall never say more than so many. Something that stands along a wall is
// within the tolerance of where a pose wrong by up to 0.75 m expects that wall once in 7.5 times:
// no length of it speaks for a pose by more than log 7.5, five statements of log 0.79 / 0.53.
constexpr double kMostOfWall = 5.0;

double fieldOf(const scan::ScanGeometry& geometry) {
  return std::abs(geometry.angles().back() - geometry.angles().front());
}

// Beams that end on each wall.
class HitsByWall {
 public:
  void add(const world::WallIndex& wall) {
    const auto is_it = [&](const Hits& hits) {
      return hits.wall.room == wall.room && hits.wall.wall == wall.wall;
    };
    const auto found = std::find_if(hits_.rbegin(), hits_.rend(), is_it);
    if (found != hits_.rend()) {
      found->beams += 1.0;
    } else {
      hits_.push_back({wall, 1.0});
    }
  }
  // Those that repeat what others say, where each is this share of an independent statement.
  double repeated(double weight) const {
    double sum = 0.0;
    for (const Hits& hits : hits_) {
      const double ratio = hits.beams * weight / kMostOfWall;
      sum += hits.beams * ratio / (1.0 + ratio);
    }
    return sum;
  }

 private:
  struct Hits {
    world::WallIndex wall;
    double beams;
  };
  std::vector<Hits> hits_;
};

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
  const double hits = static_cast<double>(agreement.on_wall) - agreement.repeated;
  return weightOf(agreement, geometry) *
         (right.logOf(hits, agreement) - elsewhere.logOf(hits, agreement));
}

double logOdds(const ScanAgreement& agreement, const scan::ScanGeometry& geometry) {
  const auto hits = static_cast<double>(agreement.on_wall);
  return weightOf(agreement, geometry) *
         (kRight.logOf(hits, agreement) - kElsewhere.logOf(hits, agreement));
}

bool tellsPlacesApart(const scan::ScanGeometry& geometry) {
  return fieldOf(geometry) >= kWideField;
}

ScanAgreement scanAgreement(const scan::Scan& scan, const geometry::Pose2& T_map_sensor,
                            const world::RoomView& view, double tolerance, std::size_t stride) {
  const Eigen::Matrix2d rotation = T_map_sensor.rotation();
  ScanAgreement agreement;
  HitsByWall hits;
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
      hits.add(sighting->wall);
    }
  }
  agreement.repeated = hits.repeated(weightOf(agreement, *scan.geometry()));
  return agreement;
}

}  // namespace sightline::tracking
