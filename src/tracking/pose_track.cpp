#include "sightline/tracking/pose_track.h"

#include <algorithm>
#include <cmath>
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
    const world::WallIndex index{wall.room, wall.wall};
    const world::Wall& known = context.map.wall(index);
    const geometry::Segment& expected = known.segment;
    const auto innovation =
        filter.innovation(wall.fit->line, expected.line(), wall.fit->motion_jacobian,
                          WallError(index, expected, context.config.wall.of(known)));
    wall.innovation = WallInnovation{innovation.value, innovation.nis};
    if (innovation.nis <= context.config.wall.max_nis) {
      filter.update(innovation);
    } else {
      wall.refusal = WallRefusal::kOutsideGate;
    }
  }
}

// Log odds of what explains a scan beside the prediction.
constexpr struct {
  double coasting = -2.0;
  double slip = -6.0;
  double no_walls = -2.0;
  double close_walls = -1.0;
  // What counts as close [m, rad], one sigma.
  double close_position = 0.05;
  double close_heading = 0.015;
  // Beams that meet walls of the map and yet belong to no wall that corrects the pose: more than
  // this share of them is not as predicted, and costs this log odds where it is all of them.
  double most_unused = 0.15;
  double unused = -8.0;
  double learning = 0.1;  // of how many beams meet walls, by a scan
} kPriors;

double unusedShare(const PoseTrack::Explanation& explanation) {
  double used = 0.0;
  for (const WallUpdate& wall : explanation.walls) {
    if (wall.accepted()) used += static_cast<double>(wall.acceptedBeams());
  }
  const auto met = static_cast<double>(explanation.agreement.on_wall);
  return met > 0.0 ? std::max(0.0, 1.0 - used / met) : 0.0;
}

bool contradictsPrediction(const TrackerInput& input, const PoseTrack::Explanation& explanation,
                           double min_quality) {
  const ScanAgreement& agreement = explanation.agreement;
  if (agreement.evidence() >= kLeastEvidence && agreement.quality() < min_quality) return true;
  if (logOdds(agreement, *input.scan.geometry()) < 0.0) return true;
  if (unusedShare(explanation) > kPriors.most_unused) return true;
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
  coasting_.reset();
  if (!step) return;
  if (last_motion_) {
    coasting_ = filter_;
    coasting_->predict(context.config.odometry, *last_motion_);
    coasting_->inflate(0.1 * last_motion_->translation().norm(),
                       0.1 * std::abs(last_motion_->theta()));
  }
  filter_.predict(context.config.odometry, *step);
}

PoseTrack::Explanation PoseTrack::explainFrom(const PoseFilter& prior,
                                              const PoseFilter& looked_from,
                                              const TrackingContext& context,
                                              const TrackerInput& input, const Sweep& sweep) const {
  Explanation explanation{prior, {}, {}, 0.0};
  const WallFinder finder(context.config);
  for (WallFit& fit :
       finder.find(looked_from, context.map, wallsInSight(context, memory_.room()), sweep)) {
    explanation.walls.emplace_back(std::move(fit));
  }
  explanation.filter.beginSweep(sweep.motion_noise);
  applyWalls(context, explanation.filter, explanation.walls);
  judge(context, input, explanation);
  return explanation;
}

void PoseTrack::judge(const TrackingContext& context, const TrackerInput& input,
                      Explanation& explanation) const {
  using Doors = world::RoomView::Doors;
  explanation.agreement =
      agreementAt(context, input, explanation.filter.pose().mean, memory_.room(),
                  context.config.neighbours ? Doors::kOpen : Doors::kIgnored);
  explanation.log_posterior =
      logLikelihood(explanation.agreement, *input.scan.geometry(), usual_hits_);
  for (const WallUpdate& wall : explanation.walls) {
    if (!wall.innovation) continue;
    explanation.log_posterior -= 0.5 * std::min(wall.innovation->nis, context.config.wall.max_nis);
  }
  explanation.log_posterior += kPriors.unused * unusedShare(explanation);
}

// The walls that were found were none: the pose stays as predicted.
PoseTrack::Explanation PoseTrack::withoutWalls(const Explanation& taken,
                                               const TrackingContext& context,
                                               const TrackerInput& input) const {
  Explanation none{filter_, taken.walls, {}, 0.0};
  judge(context, input, none);
  none.log_posterior =
      logLikelihood(none.agreement, *input.scan.geometry(), usual_hits_) + kPriors.unused;
  for (WallUpdate& wall : none.walls) {
    if (wall.accepted()) wall.refusal = WallRefusal::kOutsideGate;
  }
  return none;
}

PoseTrack::Explanation PoseTrack::explain(const TrackingContext& context,
                                          const TrackerInput& input) const {
  const SlipConfig& slip = context.config.slip;
  const Sweep sweep = readSweep(input.scan, input.T_base_sensor);
  Explanation best = explainFrom(filter_, filter_, context, input, sweep);
  if (!contradictsPrediction(input, best, slip.min_quality)) return best;
  const auto consider = [&best](Explanation other, double log_prior) {
    other.log_posterior += log_prior;
    if (other.log_posterior > best.log_posterior) best = std::move(other);
  };
  const Explanation taken = best;
  const PoseFilter close = filter_.limited(kPriors.close_position, kPriors.close_heading);
  Explanation by_close_walls = explainFrom(filter_, close, context, input, sweep);
  for (std::size_t i = 0; i < taken.walls.size(); ++i) {
    by_close_walls.walls[i].gate = taken.walls[i].gate;  // what the prediction leaves open
    by_close_walls.walls[i].beams_in_gate = taken.walls[i].beams_in_gate;
  }
  consider(std::move(by_close_walls), kPriors.close_walls);
  consider(withoutWalls(taken, context, input), kPriors.no_walls);
  if (coasting_)
    consider(explainFrom(*coasting_, *coasting_, context, input, sweep), kPriors.coasting);
  PoseFilter slipped = filter_;
  slipped.inflate(slip.position_sigma, slip.heading_sigma);
  consider(explainFrom(slipped, slipped, context, input, sweep), kPriors.slip);
  return best;
}

void PoseTrack::learnHits(const ScanAgreement& agreement) {
  if (agreement.judged() < kLeastEvidence) return;
  const double hits =
      static_cast<double>(agreement.on_wall) / static_cast<double>(agreement.judged());
  usual_hits_ += kPriors.learning * (hits - usual_hits_);
}

TrackerUpdate PoseTrack::commit(const TrackingContext& context, const TrackerInput& input,
                                Explanation explanation) {
  filter_ = explanation.filter;
  learnHits(explanation.agreement);
  if (before_) last_motion_ = geometry::between(*before_, pose().mean);
  before_ = pose().mean;
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
