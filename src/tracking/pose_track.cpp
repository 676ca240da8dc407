#include "sightline/tracking/pose_track.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sightline::tracking {

namespace {

// Walls of a room, and of those behind its doors.
std::vector<world::WallIndex> wallsInSight(const TrackingContext& context, std::size_t room) {
  std::vector<std::size_t> rooms{room};
  for (const world::Door& door : context.map.doors()) {
    for (const std::size_t side : {0U, 1U}) {
      const std::size_t other = door.rooms[side];
      const bool leads_there = context.config.neighbours && door.rooms[1 - side] == room;
      if (leads_there && std::find(rooms.begin(), rooms.end(), other) == rooms.end()) {
        rooms.push_back(other);
      }
    }
  }
  std::vector<world::WallIndex> walls;
  for (const std::size_t seen : rooms) {
    for (std::size_t wall = 0; wall < context.map.rooms()[seen].walls.size(); ++wall) {
      walls.push_back({seen, wall});
    }
  }
  return walls;
}

// The best-seen wall first: it leaves the others the least room for error.
std::vector<std::size_t> byBeams(const std::vector<WallUpdate>& walls) {
  std::vector<std::size_t> order(walls.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return walls[a].acceptedBeams() > walls[b].acceptedBeams();
  });
  return order;
}

void applyWalls(const TrackingContext& context, PoseFilter& filter,
                std::vector<WallUpdate>& walls) {
  for (const std::size_t i : byBeams(walls)) {
    WallUpdate& wall = walls[i];
    if (!wall.fit) continue;
    const auto& expected = context.map.wall({wall.room, wall.wall}).segment;
    const auto innovation =
        filter.innovation(wall.fit->line, expected.line(), wall.fit->motion_jacobian);
    wall.innovation = WallInnovation{innovation.value, innovation.nis};
    if (innovation.nis <= context.config.wall.max_nis) {
      filter.update(innovation);
    } else {
      wall.refusal = WallRefusal::kOutsideGate;
    }
  }
}

bool contradictsPrediction(const PoseTrack::Explanation& explanation, double min_quality) {
  const ScanAgreement& agreement = explanation.agreement;
  if (agreement.evidence() >= kLeastEvidence && agreement.quality() < min_quality) return true;
  // Walls well seen and yet refused: gates must not lock out for ever what contradicts a wrong
  // prediction.
  std::size_t accepted = 0;
  std::size_t refused = 0;
  for (const WallUpdate& wall : explanation.walls) {
    (wall.accepted() ? accepted : refused) += wall.acceptedBeams();
  }
  return refused > accepted;
}

}  // namespace

PoseTrack::PoseTrack(const TrackingContext& context, const geometry::UncertainPose2& start,
                     std::size_t room)
    : filter_(context.config.odometry, start), memory_(room) {}

void PoseTrack::predict(const TrackingContext& context, const TrackerInput& input) {
  const auto step = memory_.step(input);
  if (step) filter_.predict(context.config.odometry, *step);
}

PoseTrack::Explanation PoseTrack::explainFrom(const PoseFilter& prior,
                                              const TrackingContext& context,
                                              const TrackerInput& input, const Sweep& sweep) const {
  using Doors = world::RoomView::Doors;
  Explanation explanation{prior, {}, {}};
  const WallFinder finder(context.config);
  for (WallFit& fit :
       finder.find(prior, context.map, wallsInSight(context, memory_.room()), sweep)) {
    explanation.walls.emplace_back(std::move(fit));
  }
  explanation.filter.beginSweep(sweep.motion_noise);
  applyWalls(context, explanation.filter, explanation.walls);
  explanation.agreement =
      agreementAt(context, input, explanation.filter.pose().mean, memory_.room(),
                  context.config.neighbours ? Doors::kOpen : Doors::kIgnored);
  return explanation;
}

PoseTrack::Explanation PoseTrack::explain(const TrackingContext& context,
                                          const TrackerInput& input) const {
  const SlipConfig& slip = context.config.slip;
  const Sweep sweep = readSweep(input.scan, input.T_base_sensor);
  Explanation as_predicted = explainFrom(filter_, context, input, sweep);
  if (!contradictsPrediction(as_predicted, slip.min_quality)) return as_predicted;
  PoseFilter slipped = filter_;
  slipped.inflate(slip.position_sigma, slip.heading_sigma);
  Explanation as_slip = explainFrom(slipped, context, input, sweep);
  const bool better = as_slip.agreement.support() > as_predicted.agreement.support();
  return better ? as_slip : as_predicted;
}

TrackerUpdate PoseTrack::commit(const TrackingContext& context, const TrackerInput& input,
                                Explanation explanation) {
  filter_ = explanation.filter;
  TrackerUpdate update = memory_.report(context, input, pose(), explanation.agreement);
  update.odometry_scale = filter_.scale();
  update.odometry_scale_sigma = filter_.scaleSigma();
  update.covariance_valid = update.state != TrackerState::kLost;
  update.walls = std::move(explanation.walls);
  if (memory_.changeRoom(context.map, pose().mean.translation())) {
    inflate(context.config.threshold_position_sigma, context.config.threshold_heading_sigma);
  }
  return update;
}

std::optional<TrackerUpdate> PoseTrack::update(const TrackingContext& context,
                                               const TrackerInput& input) {
  if (memory_.isOlder(input)) return std::nullopt;
  predict(context, input);
  return commit(context, input, explain(context, input));
}

void PoseTrack::inflate(double position_sigma, double heading_sigma) {
  filter_.inflate(position_sigma, heading_sigma);
}

}  // namespace sightline::tracking
