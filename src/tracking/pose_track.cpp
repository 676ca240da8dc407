#include "sightline/tracking/pose_track.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sightline/tracking/pose_belief.h"
#include "sightline/tracking/wall_finder.h"

namespace sightline::tracking {

namespace {

// Log odds of what explains a scan beside the prediction.
constexpr struct {
  double coasting = -2.0;
  double slip = -6.0;
  double slip_again = -2.0;  // of wheels that were wrong a moment ago
  double no_walls = -2.0;
  double close_walls = -1.0;
  // Log odds of wheels that were wrong a moment ago.
  double distrusted = -4.0;
  std::int64_t longest_distrust = 3'000'000'000;  // [ns]
  // Steps of wheels and of the motion going on are one within this [m, rad].
  double same_step = 0.015;
  double same_turn = 0.01;
  // Errors of the motion going on for a while, beside a tenth of it [m, rad].
  double coasting_position = 0.003;
  double coasting_heading = 0.003;
  double standing = 0.002;  // step of wheels that stand [m, rad]
  // Sum of normalised innovations squared of the walls, past which wheels that have stopped may be
  // wrong.
  double most_nis = 16.0;
  // What counts as close [m, rad], one sigma.
  double close_position = 0.05;
  double close_heading = 0.015;
  // Beams that meet walls of the map and yet belong to no wall that corrects the pose: more than
  // this share of them is not as predicted, and costs this log odds where it is all of them.
  double most_unused = 0.15;
  double unused = -8.0;
  double enough_hits = 0.3;  // share of all beams on walls from which on that holds in full
  double learning = 0.1;     // of how many beams meet walls, by a scan
  // Independent statements of beams on walls that a slip of the wheels takes to be believed.
  double least_support = 10.0;
  double proof = 20.0;  // and wheels, not to be believed for a while
} kPriors;

// Log-likelihood of a scan by a motion of a known robot, to which each beam on a wall speaks.
double withRepeats(ScanAgreement agreement, const scan::Scan& scan, double usual_hits) {
  agreement.repeated = 0.0;
  return logLikelihood(agreement, *scan.geometry(), usual_hits);
}

// What compares choices of lines for walls: a longer line is not the likelier wall.
double asChoice(const Explanation& explanation) {
  return explanation.log_posterior - explanation.log_repeats;
}

void keepBetter(Explanation& best, Explanation other, double log_prior,
                Explanation::Motion motion) {
  other.log_posterior += log_prior;
  other.motion = motion;
  if (other.log_posterior > best.log_posterior) best = std::move(other);
}

// Whether few beams on walls speak for it.
bool isWeak(const Explanation& explanation, const TrackerInput& input) {
  return supportOf(explanation.agreement, *input.scan.geometry()) < kPriors.least_support;
}

// Reports the gates that the prediction leaves open.
void showGatesOf(const Explanation& predicted, Explanation& explanation) {
  for (std::size_t i = 0; i < predicted.walls.size(); ++i) {
    explanation.walls[i].gate = predicted.walls[i].gate;
    explanation.walls[i].beams_in_gate = predicted.walls[i].beams_in_gate;
  }
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
    const double more = distrusted_at_ ? 1.0 : 0.0;
    coasting_->inflate(0.1 * last_motion_->translation().norm() + more * kPriors.coasting_position,
                       0.1 * std::abs(last_motion_->theta()) + more * kPriors.coasting_heading);
  }
  step_ = step;
  filter_.predict(context.config.odometry, *step);
}

Explanation PoseTrack::explainFrom(const PoseFilter& prior, const PoseFilter& looked_from,
                                   WallFinder::Lines lines, const TrackingContext& context,
                                   const TrackerInput& input, const Sweep& sweep) const {
  const WallFinder finder(context.config);
  std::optional<Explanation> best;
  const auto walls = wallsInSight(context, memory_.room());
  for (auto& fits : finder.find(looked_from, context.map, walls, sweep, lines)) {
    Explanation explanation = explainBy(std::move(fits), prior, context, input, sweep);
    if (!best || asChoice(explanation) > asChoice(*best)) best = std::move(explanation);
  }
  return *best;
}

Explanation PoseTrack::explainBy(std::vector<WallFit> fits, const PoseFilter& prior,
                                 const TrackingContext& context, const TrackerInput& input,
                                 const Sweep& sweep) const {
  Explanation explanation{prior, {}, {}};
  for (WallFit& fit : fits) explanation.walls.emplace_back(std::move(fit));
  explanation.filter.beginSweep(sweep.motion_noise);
  applyWalls(context, *input.scan.geometry(), explanation.filter, explanation.walls);
  applyJambs(context, memory_.room(), sweep, explanation.filter);
  judge(context, input, explanation);
  return explanation;
}

void PoseTrack::judge(const TrackingContext& context, const TrackerInput& input,
                      Explanation& explanation) const {
  using Doors = world::RoomView::Doors;
  explanation.agreement =
      agreementAt(context, input, explanation.filter.pose().mean, memory_.room(),
                  context.config.neighbours ? Doors::kOpen : Doors::kIgnored);
  explanation.log_posterior = withRepeats(explanation.agreement, input.scan, usual_hits_);
  explanation.log_repeats =
      explanation.log_posterior -
      logLikelihood(explanation.agreement, *input.scan.geometry(), usual_hits_);
  for (const WallUpdate& wall : explanation.walls) {
    if (!wall.innovation) continue;
    explanation.log_posterior -= 0.5 * std::min(wall.innovation->nis, context.config.wall.max_nis);
  }
  const ScanAgreement& seen = explanation.agreement;
  const double enough =
      kPriors.enough_hits * static_cast<double>(std::max<std::size_t>(1, seen.looked_at));
  const double hits = std::min(1.0, static_cast<double>(seen.on_wall) / enough);
  explanation.log_posterior += kPriors.unused * hits * unusedShare(explanation);
}

// The walls that were found were none: the pose stays as predicted.
Explanation PoseTrack::withoutWalls(const Explanation& taken, const TrackingContext& context,
                                    const TrackerInput& input) const {
  Explanation none{filter_, taken.walls, {}};
  judge(context, input, none);
  none.log_posterior = withRepeats(none.agreement, input.scan, usual_hits_) + kPriors.unused;
  for (WallUpdate& wall : none.walls) {
    if (wall.accepted()) wall.refusal = WallRefusal::kOutsideGate;
  }
  return none;
}

// Whether the wheels report what the robot did before.
bool PoseTrack::goesOn() const {
  if (!step_ || !last_motion_) return true;
  const geometry::Pose2 change = geometry::between(*step_, *last_motion_);
  return change.translation().norm() < kPriors.same_step &&
         std::abs(change.theta()) < kPriors.same_turn;
}

bool PoseTrack::isContradicted(const TrackingContext& context, const TrackerInput& input,
                               const Explanation& explanation) const {
  const ScanAgreement& agreement = explanation.agreement;
  if (agreement.evidence() >= kLeastEvidence &&
      agreement.quality() < context.config.slip.min_quality) {
    return true;
  }
  if (logOdds(agreement, *input.scan.geometry()) < 0.0) return true;
  if (unusedShare(explanation) > kPriors.most_unused) return true;
  return areWallsRefused(explanation.walls);
}

bool PoseTrack::haveStopped() const {
  return step_ && step_->translation().norm() < kPriors.standing &&
         std::abs(step_->theta()) < kPriors.standing && !goesOn();
}

// Whether the wheels have stopped from one scan to the next, and the walls take it reluctantly: it
// may be their reports that have stopped.
bool PoseTrack::isMotionDoubted(const Explanation& explanation) const {
  return haveStopped() && nisOf(explanation.walls) > kPriors.most_nis;
}

Explanation PoseTrack::explain(const TrackingContext& context, const TrackerInput& input) const {
  using Lines = WallFinder::Lines;
  using Motion = Explanation::Motion;
  const Sweep sweep = readSweep(input.scan, input.T_base_sensor);
  const auto lookFrom = [&](const PoseFilter& prior, const PoseFilter& looked_from,
                            Lines lines = Lines::kHeaviest) {
    return explainFrom(prior, looked_from, lines, context, input, sweep);
  };
  Explanation best = lookFrom(filter_, filter_, Lines::kAll);
  const Explanation taken = best;
  if (coasting_ && distrusted_at_) {
    best.log_posterior += kPriors.distrusted;
    keepBetter(best, lookFrom(*coasting_, *coasting_), 0.0, Motion::kCoasting);
  }
  const bool is_contradicted = isContradicted(context, input, best);
  if (!is_contradicted && !isMotionDoubted(best)) return best;
  if (is_contradicted) {
    const PoseFilter close = filter_.limited(kPriors.close_position, kPriors.close_heading);
    Explanation by_close_walls = lookFrom(filter_, close);
    showGatesOf(taken, by_close_walls);
    keepBetter(best, std::move(by_close_walls), kPriors.close_walls, Motion::kUnknown);
    keepBetter(best, withoutWalls(taken, context, input), kPriors.no_walls, Motion::kUnknown);
  }
  if (coasting_ && !distrusted_at_) {
    keepBetter(best, lookFrom(*coasting_, *coasting_), kPriors.coasting, Motion::kCoasting);
  }
  if (!is_contradicted || !tellsPlacesApart(*input.scan.geometry())) return best;
  PoseFilter slipped = coasting_ && distrusted_at_ ? *coasting_ : filter_;
  slipped.inflate(context.config.slip.position_sigma, context.config.slip.heading_sigma);
  const double log_prior = distrusted_at_ ? kPriors.slip_again : kPriors.slip;
  return slippedOr(std::move(best), lookFrom(slipped, slipped), log_prior, input);
}

// The better one. A slip by which more beams go through walls moves no pose, nor does one that few
// walls speak for, not all of them found as lines, while no beams go through walls without it:
// things that stand along walls look like one.
Explanation PoseTrack::slippedOr(Explanation best, Explanation slipped, double log_prior,
                                 const TrackerInput& input) {
  if (slipped.log_posterior + log_prior <= best.log_posterior) return best;
  const ScanAgreement& agreement = slipped.agreement;
  const bool is_worse = goesThroughWalls(agreement) && agreement.beyond > best.agreement.beyond;
  const bool is_weak = isWeak(slipped, input) && unusedShare(slipped) > kPriors.most_unused &&
                       !goesThroughWalls(best.agreement);
  if (is_worse || is_weak) {
    best.may_have_slipped = true;
    return best;
  }
  slipped.log_posterior += log_prior;
  slipped.motion = Explanation::Motion::kSlip;
  return slipped;
}

// Wheels that have stopped reporting are likely to be silent at the next scan, too.
void PoseTrack::learnMotion(const TrackerInput& input, const Explanation& explanation) {
  using Motion = Explanation::Motion;
  const geometry::Pose2 after = explanation.filter.pose().mean;
  const bool goes_on = explanation.motion == Motion::kCoasting;
  const bool is_wrong = haveStopped() && (goes_on || explanation.motion == Motion::kSlip) &&
                        supportOf(explanation.agreement, *input.scan.geometry()) >= kPriors.proof;
  if (is_wrong && !distrusted_at_) distrusted_at_ = input.scan.stamp;
  const bool is_over =
      explanation.motion == Motion::kWheels || (goes_on && goesOn()) ||
      (distrusted_at_ && input.scan.stamp - *distrusted_at_ > kPriors.longest_distrust);
  if (is_over) distrusted_at_.reset();
  const bool is_motion = goes_on || explanation.motion == Motion::kWheels;
  if (before_ && is_motion) {
    last_motion_ = geometry::between(*before_, after);
  }
  before_ = after;
}

void PoseTrack::learnHits(const ScanAgreement& agreement) {
  if (agreement.judged() < kLeastEvidence) return;
  const double hits =
      static_cast<double>(agreement.on_wall) / static_cast<double>(agreement.judged());
  usual_hits_ += kPriors.learning * (hits - usual_hits_);
}

TrackerUpdate PoseTrack::commit(const TrackingContext& context, const TrackerInput& input,
                                Explanation explanation) {
  learnMotion(input, explanation);
  filter_ = explanation.filter;
  learnHits(explanation.agreement);
  TrackerUpdate update = memory_.report(context, input, pose(), explanation.agreement);
  update.odometry_scale = filter_.scale();
  update.odometry_scale_sigma = filter_.scaleSigma();
  update.covariance_valid = update.state != TrackerState::kLost;
  const bool is_slip = explanation.motion == Explanation::Motion::kSlip;
  update.jumped = explanation.may_have_slipped || (is_slip && isWeak(explanation, input));
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
