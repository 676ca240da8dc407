#include "sightline/lines/arc_finder.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/angle.h"
#include "sightline/geometry/statistics.h"
#include "sightline/lines/beam_motion.h"
#include "sightline/lines/neighbour_beam.h"

namespace sightline::lines {

namespace {

using fitting::ArcFit;

struct ArcFinderConstants {
  // Chosen, not measured: what a run may leave unexplained, and how well the radius has to be
  // known.
  double stray_ratio = 0.2;      // of the returns of a run
  double radius_known = 0.5;     // standard deviation of the radius over the radius, at most
  std::size_t few_returns = 24;  // that tell whether to fit a circle to all of a run
  // Counted: each parameter costs the logarithm of the number of returns (Schwarz 1978), or what
  // chance may gain by it and by a break.
  double arc_parameters = 3.0;
  double line_parameters = 2.0;
};
constexpr ArcFinderConstants kArcs{};

// Whether a run holds most of a piece. A wall that goes on behind a round thing has the run of the
// thing among its returns, and is no chord of it.
bool holds(const Run& run, const Piece& piece, std::size_t revolution) {
  std::size_t common = 0;
  for (const std::size_t shift : {std::size_t{0}, revolution}) {
    const std::size_t first = std::max(piece.first + shift, run.first);
    const std::size_t end = std::min(piece.end + shift, run.end);
    if (first < end) common += end - first;
  }
  return 2 * common > piece.size();
}

// Cost of the straight line through the returns that minimises their squared distances, each return
// weighted alike: good enough to be compared with.
double costOfLine(const std::vector<fitting::ArcReturn>& returns, double gate_squared) {
  Eigen::Vector2d middle(0, 0);
  for (const auto& of : returns) middle += of.point;
  middle /= static_cast<double>(returns.size());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const auto& of : returns) {
    const Eigen::Vector2d p = of.point - middle;
    xx += p.x() * p.x();
    xy += p.x() * p.y();
    yy += p.y() * p.y();
  }
  const double along = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const Eigen::Vector2d normal(-std::sin(along), std::cos(along));
  double cost = 0.0;
  for (const auto& of : returns) {
    const double facing = normal.dot(of.direction);
    const double variance =
        facing * facing * of.range_variance + (1.0 - facing * facing) * of.across_variance;
    const double distance = normal.dot(of.point - middle);
    cost += std::min(gate_squared, distance * distance / variance);
  }
  return cost;
}

Eigen::Vector2d meanPoint(const BeamArray& beams, std::size_t first, std::size_t end) {
  float x = 0.0F;
  float y = 0.0F;
  for (std::size_t i = first; i < end; ++i) {
    x += beams.x[i] - beams.x[first];
    y += beams.y[i] - beams.y[first];
  }
  const auto count = static_cast<float>(end - first);
  return {static_cast<double>(beams.x[first] + x / count),
          static_cast<double>(beams.y[first] + y / count)};
}

// Whether the middle third of a run is off the line through the other two by more than the standard
// deviation of that. Other runs gain nothing by being round, and most that are left over in a room
// are of that kind.
bool bends(const BeamArray& beams, const Run& run) {
  const std::size_t third = run.size() / 3;
  const Eigen::Vector2d first = meanPoint(beams, run.first, run.first + third);
  const Eigen::Vector2d middle = meanPoint(beams, run.first + third, run.end - third);
  const Eigen::Vector2d last = meanPoint(beams, run.end - third, run.end);
  const Eigen::Vector2d chord = last - first;
  const std::size_t at = run.first + run.size() / 2;
  const double off = chord.x() * (middle.y() - first.y()) - chord.y() * (middle.x() - first.x());
  const double facing = chord.x() * static_cast<double>(beams.direction_y[at]) -
                        chord.y() * static_cast<double>(beams.direction_x[at]);
  const double variance = 1.5 / static_cast<double>(third) * facing * facing *
                          static_cast<double>(beams.range_variance[at]);
  return off * off > variance;
}

geometry::Arc toArc(const ArcFit& fit, const scan::Scan& scan, const BeamArray& beams,
                    const Run& run) {
  const auto directionOf = [&](std::size_t i) {
    return std::atan2(static_cast<double>(beams.y[i]) - fit.centre.y(),
                      static_cast<double>(beams.x[i]) - fit.centre.x());
  };
  geometry::Arc arc;
  arc.centre = fit.centre;
  arc.radius = fit.radius;
  arc.covariance = fit.covariance;
  arc.start_angle = directionOf(run.first);
  arc.end_angle = directionOf(run.end - 1);
  // Seen from outside, the point runs round the circle against the sense of the sweep.
  if (fit.convex == (scan.geometry()->angleIncrement() > 0.0)) {
    std::swap(arc.start_angle, arc.end_angle);
  }
  if (arc.end_angle < arc.start_angle) arc.end_angle += 2.0 * geometry::kPi;
  arc.first_beam = beams.beam[run.first] % scan.beams();
  arc.last_beam = beams.beam[run.end - 1] % scan.beams();
  arc.beams = fit.returns;
  arc.chi_square = fit.chi_square;
  arc.degrees_of_freedom = fit.observations() - 3;
  return arc;
}

}  // namespace

ArcFinder::ArcFinder(const LineExtractorConfig& config)
    : config_(config), gate_squared_(config.gate * config.gate), runs_(config) {}

void ArcFinder::find(const scan::Scan& scan, const BeamArray& beams, std::vector<Piece>& pieces,
                     std::vector<geometry::Arc>& arcs) {
  if (config_.max_radius <= 0.0 || beams.revolution == 0) return;
  observations_.returns.reserve(beams.beam.size());
  observations_.tangents.reserve(2);
  tangent_beams_.reserve(2);
  runs_.assign(beams, pieces);
  for (const Run& run : runs_.withDoubtfulWalls()) {
    if (consider(scan, beams, run, pieces, arcs)) continue;
    for (const Run& loose : runs_.withoutWalls(run)) {
      if (loose.size() < run.size()) consider(scan, beams, loose, pieces, arcs);
    }
  }
}

bool ArcFinder::consider(const scan::Scan& scan, const BeamArray& beams, const Run& run,
                         std::vector<Piece>& pieces, std::vector<geometry::Arc>& arcs) {
  if (run.size() < static_cast<std::size_t>(config_.min_arc_beams)) return false;
  if (!bends(beams, run) || !mayBeRound(scan, beams, run)) return false;
  observe(scan, beams, run, 1);
  const auto fit = fitting::fitArc(observations_, config_.gate);
  if (!fit || !isPlausible(*fit) || !isLikelier(*fit, beams, run, pieces)) return false;
  if (isBetterDivided(*fit, beams, run, pieces)) return false;
  arcs.push_back(toArc(*fit, scan, beams, run));
  arcs.back().covariance += motionCovariance(scan, beams, run, *fit);
  const auto isChord = [&](const Piece& piece) { return holds(run, piece, beams.revolution); };
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(), isChord), pieces.end());
  return true;
}

// Whether a few returns of a long run lie on a circle that is small enough: a fit to all of them is
// dear, and most long runs are of walls that meet at obtuse angles.
bool ArcFinder::mayBeRound(const scan::Scan& scan, const BeamArray& beams, const Run& run) {
  const std::size_t stride = run.size() / kArcs.few_returns;
  if (stride < 2) return true;
  observe(scan, beams, run, stride);
  const auto fit = fitting::fitArc(observations_, config_.gate);
  if (!fit) return false;
  const double radius_sigma = std::sqrt(fit->covariance(2, 2));
  const auto strays = static_cast<double>(observations_.returns.size() - fit->returns);
  return fit->radius - config_.gate * radius_sigma <= config_.max_radius &&
         strays <= kArcs.stray_ratio * static_cast<double>(observations_.returns.size()) &&
         isExplained(*fit);
}

void ArcFinder::observe(const scan::Scan& scan, const BeamArray& beams, const Run& run,
                        std::size_t stride) {
  observations_.returns.clear();
  observations_.tangents.clear();
  tangent_beams_.clear();
  for (std::size_t i = run.first; i < run.end; i += stride) {
    fitting::ArcReturn of;
    of.point = {static_cast<double>(beams.x[i]), static_cast<double>(beams.y[i])};
    of.direction = {static_cast<double>(beams.direction_x[i]),
                    static_cast<double>(beams.direction_y[i])};
    of.range_variance = static_cast<double>(beams.range_variance[i]);
    of.across_variance = static_cast<double>(beams.across_variance[i]);
    of.spacing =
        scan.ranges()[beams.beam[i] % scan.beams()] * std::abs(scan.geometry()->angleIncrement());
    observations_.returns.push_back(of);
  }
  if (run.size() == beams.revolution) return;  // nothing passes by what is all around
  observeTangent(scan, beams.beam[run.first] % scan.beams(), Side::kStart);
  observeTangent(scan, beams.beam[run.end - 1] % scan.beams(), Side::kEnd);
}

void ArcFinder::observeTangent(const scan::Scan& scan, std::size_t beam, Side side) {
  const std::size_t next = nextTellingBeam(scan, beam, side == Side::kEnd ? 1 : -1);
  if (next == beam) return;
  const bool passes = scan.kinds()[next] == scan::ReturnKind::kNothing ||
                      (scan.isValid(next) && scan.ranges()[next] > scan.ranges()[beam]);
  if (!passes) return;
  const Eigen::Vector2d on = scan.direction(beam);
  const Eigen::Vector2d past = scan.direction(next);
  fitting::ArcTangent tangent;
  tangent.direction = (on + past).normalized();
  tangent.origin =
      scan.sensorMotion().empty() ? Eigen::Vector2d(0, 0) : scan.sensorMotion()[beam].translation();
  const double range = scan.ranges()[beam];
  const double step = range * (past - on).norm();
  // The tangent lies between two beams, each turned by the jitter.
  tangent.variance = step * step / 12.0 + 0.5 * scan.motion_noise.jitter * range * range;
  observations_.tangents.push_back(tangent);
  tangent_beams_.push_back(beam);
}

// Drift and walk move what was seen at one time alike (pears eqs 14 and 21).
Eigen::Matrix3d ArcFinder::motionCovariance(const scan::Scan& scan, const BeamArray& beams,
                                            const Run& run, const ArcFit& fit) {
  const scan::MotionNoise& noise = scan.motion_noise;
  if (noise.drift.isZero(0.0) && noise.walk.isZero(0.0)) return Eigen::Matrix3d::Zero();
  motion_sum_.clear();
  for (std::size_t k = 0; k < observations_.returns.size(); ++k) {
    const fitting::ArcReturn& of = observations_.returns[k];
    const std::size_t beam = beams.beam[run.first + k] % scan.beams();
    motion_sum_.add(timeRatio(scan, beam), fitting::responseTo(of, fit, config_.gate) *
                                               motionJacobian(scan, beam, of.point));
  }
  for (std::size_t k = 0; k < observations_.tangents.size(); ++k) {
    motion_sum_.add(timeRatio(scan, tangent_beams_[k]),
                    fitting::responseTo(observations_.tangents[k], fit, config_.gate));
  }
  return motion_sum_.covariance(noise);
}

bool ArcFinder::isPlausible(const ArcFit& fit) const {
  const double sigma = std::sqrt(fit.covariance(2, 2));
  if (fit.radius > config_.max_radius || sigma > kArcs.radius_known * fit.radius) return false;
  const auto returns = static_cast<double>(fit.returns);
  if (returns < (1.0 - kArcs.stray_ratio) * static_cast<double>(observations_.returns.size())) {
    return false;
  }
  return returns >= config_.min_arc_beams && isExplained(fit);
}

// Whether the noise of the beams explains the residuals.
bool ArcFinder::isExplained(const ArcFit& fit) const {
  const double freedom = static_cast<double>(fit.observations()) - kArcs.arc_parameters;
  return fit.chi_square <=
         geometry::chiSquareLimit(config_.gate, freedom) * config_.misfit * config_.misfit;
}

// Whether several lines explain a run better, with the prices that the scan was divided at
// (Segmentation), however short they are: what has steps is not round.
bool ArcFinder::isBetterDivided(const ArcFit& fit, const BeamArray& beams, const Run& run,
                                const std::vector<Piece>& pieces) const {
  const auto priceOf = [&](double parameters) {
    return geometry::chiSquareLimit(config_.gate, parameters + 1.0);
  };
  double lines = 0.0;
  auto loose = static_cast<double>(run.size());
  std::size_t count = 0;
  for (const Piece& piece : pieces) {
    if (runs_.isSureWall(piece.first) || !holds(run, piece, beams.revolution)) continue;
    lines += piece.chi_square + priceOf(kArcs.line_parameters);
    loose -= piece.beams;
    ++count;
  }
  const auto strays = static_cast<double>(run.size() - fit.returns);
  const double arc = fit.chi_square + priceOf(kArcs.arc_parameters) + gate_squared_ * strays;
  return count > 1 && arc > lines + gate_squared_ * std::max(0.0, loose);
}

bool ArcFinder::isLikelier(const ArcFit& fit, const BeamArray& beams, const Run& run,
                           const std::vector<Piece>& pieces) const {
  const double price = std::log(static_cast<double>(run.size()));
  const double arc = fit.chi_square +
                     gate_squared_ * static_cast<double>(run.size() - fit.returns) +
                     kArcs.arc_parameters * price;
  double lines = 0.0;
  double loose = static_cast<double>(run.size());
  for (const Piece& piece : pieces) {
    if (!runs_.isDoubtfulWall(piece.first) || !holds(run, piece, beams.revolution)) continue;
    lines += piece.chi_square + (kArcs.line_parameters + 1.0) * price;
    loose -= piece.beams;
  }
  if (lines > 0.0) return arc < lines + gate_squared_ * std::max(0.0, loose) - price;
  // A line does not say where it ends, a circle does.
  const double parameters = kArcs.line_parameters + static_cast<double>(fit.tangents);
  lines = costOfLine(observations_.returns, gate_squared_) + parameters * price;
  // An arc whose ends are not both seen may go on straight behind what hides it.
  return arc + (fit.tangents < 2 ? gate_squared_ : 0.0) < lines;
}

}  // namespace sightline::lines
