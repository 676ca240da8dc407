#include "sightline/tracking/plain_tracker.h"

#include <utility>

#include "sightline/tracking/range_weighted_hough.h"

namespace sightline::tracking {

namespace {

using geometry::PolarLine;

using Peaks = std::vector<std::optional<PolarLine>>;

Peaks peaksOf(const HoughConfig& config, const std::vector<GatedWall>& walls) {
  const RangeWeightedHough hough(config);
  Peaks peaks;
  for (const GatedWall& wall : walls) {
    const auto peak = hough.heaviest(wall);
    peaks.emplace_back();
    if (peak) peaks.back() = lineAt(*peak, wall.gate.predicted());
  }
  return peaks;
}

void fitPlainly(const TrackerConfig& config, const GatedWall& gated,
                const std::optional<PolarLine>& peak, WallFit& result) {
  if (!peak) return;
  const auto near = nearLine(gated.points, *peak, config.gate.sigmas, 0.0);
  result.refusal = refusalOf(config.wall, near, *peak);
  if (result.refusal != WallRefusal::kNone) return;
  const auto line = fitting::refineLine(toFitPoints(near), *peak);
  result.refusal = line ? WallRefusal::kNone : WallRefusal::kUndetermined;
  if (!line) return;
  result.fit.emplace();
  result.fit->line = line->line;
  for (const BeamPoint* point : near) result.fit->accepted_beams.push_back(point->beam);
}

std::vector<WallUpdate> applyPlainly(const world::Room& room, std::vector<WallFit> fits,
                                     PlainFilter& filter) {
  std::vector<WallUpdate> updates;
  for (WallFit& fit : fits) {
    updates.emplace_back(std::move(fit));
    WallUpdate& wall = updates.back();
    if (!wall.fit) continue;
    const auto innovation =
        compareLines(filter.pose().mean, wall.fit->line, room.walls[wall.wall].segment.line());
    wall.innovation = WallInnovation{innovation.value, filter.nis(innovation)};
    filter.update(innovation);
  }
  return updates;
}

}  // namespace

std::vector<WallFit> findPlainly(const TrackerConfig& config, const PlainFilter& predicted,
                                 const world::Room& room, const Sweep& sweep) {
  std::vector<const world::Wall*> walls;
  for (const world::Wall& wall : room.walls) walls.push_back(&wall);
  const std::vector<double> exact(walls.size(), 0.0);
  const auto first = gateWalls(config.gate, walls, exact, predicted.pose(), sweep.points);
  const Peaks peaks = peaksOf(config.hough, first);
  PlainFilter refined = predicted;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const bool is_enough =
        first[i].points.size() >= static_cast<std::size_t>(config.wall.min_beams);
    if (!peaks[i] || !is_enough) continue;
    refined.update(compareLines(refined.pose().mean, *peaks[i], walls[i]->segment.line()));
  }
  auto second = gateWalls(config.gate, walls, exact, refined.pose(), sweep.points);
  giveEachBeamToOneWall(second);
  std::vector<WallFit> fits(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    fits[i].wall = i;
    fits[i].gate = first[i].gate.size();
    fits[i].beams_in_gate = first[i].points.size();
    fitPlainly(config, second[i], peaks[i], fits[i]);
  }
  return fits;
}

PlainTracker::PlainTracker(const TrackingContext&, const geometry::UncertainPose2& start,
                           std::size_t room)
    : filter_(start), memory_(room) {}

std::optional<TrackerUpdate> PlainTracker::update(const TrackingContext& context,
                                                  const TrackerInput& input) {
  if (memory_.isOlder(input)) return std::nullopt;
  const TrackerConfig& config = context.config;
  const world::Room& room = context.map.rooms()[memory_.room()];
  if (const auto step = memory_.step(input)) filter_.predict(config.plain, *step);
  Sweep sweep = readSweep(input.scan, input.T_base_sensor);
  makeIsotropic(sweep, config.plain.point_sigma);
  auto walls = applyPlainly(room, findPlainly(config, filter_, room, sweep), filter_);
  for (WallUpdate& wall : walls) wall.room = memory_.room();
  filter_.applyFloor(config.plain);
  const auto agreement =
      agreementAt(context, input, pose().mean, memory_.room(), world::RoomView::Doors::kIgnored);
  TrackerUpdate update = memory_.report(context, input, pose(), agreement);
  update.walls = std::move(walls);
  if (memory_.changeRoom(context.map, pose().mean.translation())) {
    inflate(config.threshold_position_sigma, config.threshold_heading_sigma);
  }
  return update;
}

void PlainTracker::inflate(double position_sigma, double heading_sigma) {
  filter_.inflate(position_sigma, heading_sigma);
}

}  // namespace sightline::tracking
