#include "sightline/tracking/wall_finder.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sightline/tracking/motion_response.h"
#include "sightline/tracking/reach.h"
#include "sightline/tracking/rounded_ranges.h"

namespace sightline::tracking {

namespace {

using geometry::PolarLine;
using geometry::Pose2;

constexpr struct {
  // Bound of a loop that settles after two or three rounds.
  int most_reassignments = 5;
  std::size_t most_choices = 6;
  // Log odds of a wall that is where it should be: what is parallel to it is there by chance once
  // in 7.5 times (scan_agreement.cpp).
  double found = 2.0;
  // Choices that differ by less are one: the second gates see to it [m, rad].
  double same_position = 0.04;
  double same_heading = 0.01;
  double coarse = 0.1;  // share of variance by rounding from which on its steps are looked at
} kFinder;

double varianceOf(double sigma) {
  return sigma * sigma;
}

// Walls are not as straight as lines: what the residuals show beyond the sensor's noise counts as
// noise.
PolarLine withExcess(const fitting::LineFit& fit) {
  const double excess =
      fit.chi_square / static_cast<double>(std::max<std::size_t>(1, fit.degrees_of_freedom));
  PolarLine line = fit.line;
  line.covariance *= std::max(1.0, excess);
  return line;
}

// The line by all points, or by the steps in which they are rounded where those say more.
PolarLine withRounding(const fitting::LineFit& fit, const std::vector<const BeamPoint*>& points) {
  PolarLine line = withExcess(fit);
  const double rounding = roundedAlike(points);
  line.covariance *= 1.0 + rounding;
  if (rounding < kFinder.coarse) return line;
  const auto edges = stepEdges(points);
  const auto by_edges = edges.size() > 2 ? fitting::refineLine(edges, fit.line) : std::nullopt;
  if (!by_edges) return line;
  const PolarLine other = withExcess(*by_edges);
  return other.covariance(1, 1) < line.covariance(1, 1) ? other : line;
}

FittedLine describe(const fitting::LineFit& fit, const std::vector<const BeamPoint*>& points,
                    const Eigen::Matrix3d& walk) {
  FittedLine result;
  result.line = withRounding(fit, points);
  const MotionResponse response(points, fit.line, walk);
  result.motion_jacobian = response.jacobian();
  result.line.covariance += response.strayCovariance();
  for (const BeamPoint* point : points) result.accepted_beams.push_back(point->beam);
  return result;
}

bool areOneChoice(const PoseFilter& a, const PoseFilter& b) {
  const Pose2 off = geometry::between(a.assumedPose().mean, b.assumedPose().mean);
  return off.translation().norm() < kFinder.same_position &&
         std::abs(off.theta()) < kFinder.same_heading;
}

// The best choices, each once.
template <class Choice>
std::vector<Choice> thinned(std::vector<Choice> all) {
  if (all.size() < 2) return all;
  std::stable_sort(all.begin(), all.end(),
                   [](const Choice& a, const Choice& b) { return a.score > b.score; });
  std::vector<Choice> kept;
  for (Choice& choice : all) {
    if (kept.size() >= kFinder.most_choices) break;
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Choice& other) {
      return areOneChoice(choice.filter, other.filter);
    });
    if (is_new) kept.push_back(std::move(choice));
  }
  return kept;
}

}  // namespace

// The pose by the heaviest line of each wall. It is contradictory where the pose leaves open which
// line a wall is, and that one would be refused by those before it.
WallFinder::Heaviest WallFinder::heaviest(const PoseFilter& predicted, const Question& question,
                                          const HoughPeaks& peaks) const {
  Heaviest result{predicted, false};
  bool is_open = false;
  for (std::size_t i = 0; i < question.gated.size(); ++i) {
    if (!isSeen(question.gated[i], peaks.walls[i])) continue;
    const PolarLine coarse = lineAt(peaks.walls[i].front(), question.gated[i].gate.predicted());
    const auto innovation = result.filter.innovation(coarse, question.walls[i]->segment.line(),
                                                     LineBySweepError::Zero());
    result.is_contradictory = result.is_contradictory || innovation.nis > wall_.max_nis;
    is_open = is_open || isOpen(question.gated[i], peaks.walls[i]);
    result.filter.update(innovation);
  }
  result.is_contradictory = result.is_contradictory && is_open;
  return result;
}

bool WallFinder::isSeen(const GatedWall& gated, const std::vector<WallPeak>& peaks) const {
  return !peaks.empty() && gated.points.size() >= static_cast<std::size_t>(wall_.min_beams);
}

// Whether the pose is known less well than lines lie apart: several may be the wall.
bool WallFinder::isOpen(const GatedWall& gated, const std::vector<WallPeak>& peaks) const {
  const double reach = gate_.sigmas * std::sqrt(gated.gate.predicted().covariance(0, 0));
  return reach >= kBinsApart * peaks.front().distance_bin;
}

// Each choice, with each line of one wall and without it, as far as the walls before allow.
std::vector<WallFinder::Choice> WallFinder::chosenFurther(const std::vector<Choice>& choices,
                                                          const GatedWall& gated,
                                                          const std::vector<WallPeak>& peaks,
                                                          const world::Wall& wall) const {
  std::vector<Choice> further = choices;
  for (const Choice& choice : choices) {
    for (const WallPeak& peak : peaks) {
      const PolarLine coarse = lineAt(peak, gated.gate.predicted());
      const auto innovation =
          choice.filter.innovation(coarse, wall.segment.line(), LineBySweepError::Zero());
      if (innovation.nis > gate_.sigmas * gate_.sigmas) continue;
      further.push_back(choice);
      further.back().filter.update(innovation);
      further.back().score += kFinder.found - 0.5 * innovation.nis;
    }
  }
  return further;
}

std::vector<WallFinder::Choice> WallFinder::chooseByHough(const PoseFilter& predicted,
                                                          const Question& question,
                                                          Lines lines) const {
  const HoughPeaks peaks = hough_.transform(question.gated);
  const Heaviest by_heaviest = heaviest(predicted, question, peaks);
  std::vector<Choice> choices{{by_heaviest.filter, 0.0}};
  if (lines == Lines::kHeaviest || !by_heaviest.is_contradictory) return choices;
  std::vector<Choice> others{{predicted, 0.0}};
  for (std::size_t i = 0; i < question.gated.size(); ++i) {
    if (!isSeen(question.gated[i], peaks.walls[i])) continue;
    others = thinned(chosenFurther(others, question.gated[i], peaks.walls[i], *question.walls[i]));
  }
  std::copy_if(others.begin(), others.end(), std::back_inserter(choices), [&](const Choice& other) {
    return !areOneChoice(other.filter, by_heaviest.filter);
  });
  return choices;
}

void WallFinder::addMapUncertainty(const WallConfig& known,
                                   const std::vector<const BeamPoint*>& points, PolarLine& line) {
  // The map's wall is uncertain where it was seen: a turn about that place shifts the foot of the
  // perpendicular.
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  for (const BeamPoint* point : points) centroid += point->position;
  centroid /= static_cast<double>(points.size());
  const double lever = line.direction().dot(centroid);
  const double turn = varianceOf(known.direction_sigma);
  Eigen::Matrix2d added;
  added << varianceOf(known.position_sigma) + lever * lever * turn, lever * turn, lever * turn,
      turn;
  line.covariance += added;
}

void WallFinder::fitWall(const GatedWall& gated, const world::Wall& wall, const Pose2& T_base_map,
                         const Sweep& sweep, WallFit& result) const {
  // Least squares over the beams near the line, which is moved to fit them until they stay the
  // same.
  const WallConfig known = wall_.of(wall);
  PolarLine line = geometry::transform(T_base_map, wall.segment.line());
  std::vector<const BeamPoint*> near = gated.points;
  fitting::LineFit fit;
  for (int i = 0; i < kFinder.most_reassignments; ++i) {
    result.refusal = refusalOf(wall_, near, line);
    if (result.refusal != WallRefusal::kNone) return;
    const auto refined = fitting::refineLine(toFitPoints(near), line);
    result.refusal = refined ? WallRefusal::kNone : WallRefusal::kUndetermined;
    if (!refined) return;
    fit = *refined;
    line = fit.line;
    auto next = withinReach(nearLine(gated.points, line, gate_.sigmas, known.position_sigma), line,
                            sweep.reach, gate_.sigmas);
    if (next == near) break;
    near = std::move(next);
  }
  result.refusal = refusalOf(wall_, near, line);
  if (result.refusal != WallRefusal::kNone) return;
  result.fit = describe(fit, near, sweep.motion_noise.walk);
  addMapUncertainty(known, near, result.fit->line);
}

std::vector<WallFit> WallFinder::fitFrom(const PoseFilter& refined, const Question& question,
                                         const std::vector<world::WallIndex>& indices,
                                         const Sweep& sweep) const {
  std::vector<GatedWall> second =
      gateWalls(gate_, question.walls, question.sigmas, refined.assumedPose(), sweep.points);
  giveEachBeamToOneWall(second);
  std::vector<WallFit> fits(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    fits[i].room = indices[i].room;
    fits[i].wall = indices[i].wall;
    fits[i].gate = question.gated[i].gate.size();
    fits[i].beams_in_gate = question.gated[i].points.size();
    fitWall(second[i], *question.walls[i], refined.pose().mean.inverse(), sweep, fits[i]);
  }
  return fits;
}

std::vector<std::vector<WallFit>> WallFinder::find(const PoseFilter& predicted,
                                                   const world::RoomMap& map,
                                                   const std::vector<world::WallIndex>& indices,
                                                   const Sweep& sweep, Lines lines) const {
  Question question;
  for (const world::WallIndex& index : indices) {
    question.walls.push_back(&map.wall(index));
    question.sigmas.push_back(wall_.of(*question.walls.back()).position_sigma);
  }
  question.gated =
      gateWalls(gate_, question.walls, question.sigmas, predicted.assumedPose(), sweep.points);
  std::vector<std::vector<WallFit>> results;
  for (const Choice& choice : chooseByHough(predicted, question, lines)) {
    results.push_back(fitFrom(choice.filter, question, indices, sweep));
  }
  return results;
}

}  // namespace sightline::tracking
