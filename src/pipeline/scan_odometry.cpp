#include "sightline/pipeline/scan_odometry.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "sightline/dead_reckoning/pose_difference.h"
#include "sightline/pipeline/odometry_bridge.h"
#include "sightline/pipeline/unknown_tilt.h"

namespace sightline::pipeline {

using dead_reckoning::MotionPrior;
using geometry::Pose2;

void ScanOdometryConfig::visit(config::FieldVisitor& visitor) {
  matching.visit(visitor);
  visitor.group("wheels", wheels);
  visitor.number("turn_rate_sigma", turn_rate_sigma,
                 {"rad/s", {1e-6, 10.0}, "standard deviation of a gyroscope"});
}

namespace {

constexpr struct {
  // Steps that no carrier makes are longer than what its largest velocity makes of the time, or at
  // least of so much time as messages are late [s], by these [m, rad].
  double margin = 1.5;
  double least_time = 0.3;
  double position = 0.3;
  double heading = 0.3;
  // Squared Mahalanobis distance between what the wheels say and what the scans find without them,
  // beyond which the two are compared (3 degrees of freedom, 99.9 %).
  double gate = 16.3;
  // The wheels are wrong where the scans explain so much more without them.
  double cost = 0.03;
} kWheels;

// Squared Mahalanobis distance of a step from a prior.
double distanceFrom(const MotionPrior& prior, const Pose2& step) {
  const Eigen::Vector3d off = dead_reckoning::difference(step, prior.T_before_now);
  return off.dot(prior.covariance.inverse() * off);
}

double meanRange(const scan::Scan& scan) {
  double sum = 0.0;
  std::size_t valid = 0;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    sum += scan.ranges()[i];
    ++valid;
  }
  return valid > 0 ? sum / static_cast<double>(valid) : 0.0;
}

// Learned noise that grows with the range was learned along the beams, and most of the growth where
// they graze. Across a surface, far returns err little more than near ones; they know the heading
// best, and weighed down turn fr079 by 1.4 instead of 1.0 degrees in all.
scan::Scan evenlyWeighed(const LocatedScan& located) {
  scan::Scan scan = located.scan;
  if (!located.noise) return scan;
  scan.setRangeVariances(
      std::vector<double>(scan.beams(), located.noise->variance(meanRange(scan))));
  return scan;
}

}  // namespace

ScanOdometry::ScanOdometry(const ScanOdometryConfig& config,
                           const std::optional<motion::FloorConfig>& floor)
    : config_(config), reckoner_(config.matching), floor_(floor) {
  config::validate(config);
}

void ScanOdometry::reset() {
  reckoner_.reset();
  finders_.clear();
  before_.reset();
  first_.reset();
  in_bursts_.clear();
  passed_ = {};
  on_floor_.clear();
  is_new_ = true;
  clock_was_set_ = false;
  shift_ = 0;
  period_ = 0;
}

// Wheels whose breaks nobody has bridged are taken as they are.
const std::optional<Pose2>& ScanOdometry::pathOf(const LocatedScan& located) {
  return located.T_path_base ? located.T_path_base : located.T_odom_base;
}

// The base goes on as before but for the turn.
MotionPrior ScanOdometry::asBefore(double elapsed, double turn) const {
  const Eigen::Vector3d& twist = before_->twist.mean;
  MotionPrior prior{Pose2::exp({elapsed * twist.x(), elapsed * twist.y(), turn}),
                    elapsed * elapsed * before_->twist.covariance};
  const double position = reckoner_.expectedMotion().acceleration * elapsed * elapsed;
  prior.covariance.diagonal().head<2>().array() += position * position;
  return prior;
}

double ScanOdometry::elapsedOf(const LocatedScan& located) const {
  if (!before_) return 0.0;
  if (located.elapsed && before_->scanner == located.scanner) return located.elapsed->usual;
  return 1e-9 * static_cast<double>(located.scan.stamp - before_->stamp);
}

// Tells whether the carrier can have made a step: wheels that are reset jump.
bool ScanOdometry::isPossible(const Pose2& step, double elapsed) const {
  const auto& carrier = config_.matching.carrier;
  const double time = kWheels.margin * std::max(elapsed, kWheels.least_time);
  return step.translation().norm() < carrier.max_speed * time + kWheels.position &&
         std::abs(step.theta()) < carrier.max_turn_rate * time + kWheels.heading;
}

// Matches with the prior, and without it where it says what the scans would not: wheels slip, stick
// and jump, and then the scans alone explain more.
std::optional<dead_reckoning::Match> ScanOdometry::match(const scan::Scan& scan,
                                                         const LocatedScan& located,
                                                         const Pose2& T_base_sensor) const {
  using dead_reckoning::MatchState;
  const Prior prior = priorOf(located);
  auto found = reckoner_.match(scan, T_base_sensor, prior, located.elapsed, located.scanner);
  if (!found || !prior) return found;
  const bool has_failed = found->outcome.state == MatchState::kFailed;
  const bool is_expected =
      distanceFrom(*prior, reckoner_.expectedStep(found->elapsed)) < kWheels.gate;
  if (!has_failed && is_expected) return found;
  auto alone = reckoner_.match(scan, T_base_sensor, {}, located.elapsed, located.scanner);
  if (alone->outcome.state == MatchState::kFailed) return found;
  const bool explains_more = alone->outcome.cost + kWheels.cost < found->outcome.cost;
  return has_failed || explains_more ? alone : found;
}

ScanOdometry::Prior ScanOdometry::priorOf(const LocatedScan& located) const {
  if (!before_) return std::nullopt;
  const double elapsed = elapsedOf(located);
  // Two scanners at one time: nothing moves in between.
  if (elapsed <= 0.0) return std::nullopt;
  Prior prior;
  const auto& T_path_base = pathOf(located);
  if (T_path_base && before_->T_path_base && !located.odometry_broke) {
    const Pose2 step = geometry::between(*before_->T_path_base, *T_path_base);
    if (isPossible(step, elapsed)) prior = wheelPrior(config_.wheels, step);
  }
  if (!located.turn) return prior;
  // The gyroscope knows the turn better.
  if (!prior) prior = asBefore(elapsed, *located.turn);
  prior->T_before_now = {prior->T_before_now.translation(), *located.turn};
  const double sigma = config_.turn_rate_sigma * elapsed;
  prior->covariance.row(2).setZero();
  prior->covariance.col(2).setZero();
  prior->covariance(2, 2) = sigma * sigma;
  return prior;
}

void ScanOdometry::goOnInNewTime(const LocatedScan& located) {
  clock_was_set_ = false;
  const auto& T_path_base = pathOf(located);
  const bool is_there = before_ && period_ > 0 && before_->T_path_base && T_path_base &&
                        !located.odometry_broke && isSamePlace(*before_->T_path_base, *T_path_base);
  if (is_there) {
    shift_ = before_->stamp + period_ - located.scan.stamp;
    return;
  }
  shift_ = 0;
  reckoner_.restartClock();
  before_.reset();
}

// Tells why a scan of a further scanner cannot be used with those of the first.
std::string ScanOdometry::faultOf(const LocatedScan& located) {
  if (!first_) first_ = located.scanner;
  if (located.elapsed) {
    in_bursts_.insert(located.scanner);
  } else {
    in_bursts_.erase(located.scanner);
  }
  if (located.scanner == *first_) return "";
  if (in_bursts_.count(*first_) > 0 || in_bursts_.count(located.scanner) > 0)
    return "stamps of arrival: its order among several scanners is unknown";
  const bool is_shared = config_.matching.method == dead_reckoning::Method::kSubmap;
  return is_shared ? "" : "the method takes one scanner alone";
}

void ScanOdometry::passOver(const LocatedScan& located) {
  passed_.any = true;
  passed_.odometry_broke |= located.odometry_broke;
  if (passed_.turn && located.turn) *passed_.turn += *located.turn;
  if (!located.turn) passed_.turn.reset();
}

LocatedScan ScanOdometry::withPassed(const LocatedScan& located) const {
  LocatedScan result = located;
  result.odometry_broke |= passed_.odometry_broke;
  if (!passed_.turn) result.turn.reset();
  if (result.turn) *result.turn += *passed_.turn;
  return result;
}

std::optional<dead_reckoning::DeadReckoningUpdate> ScanOdometry::update(
    const LocatedScan& located) {
  why_none_ = faultOf(located);
  auto update = !why_none_.empty() ? std::nullopt
                : passed_.any      ? updateInOrder(withPassed(located))
                                   : updateInOrder(located);
  if (update) {
    passed_ = {};
    return update;
  }
  if (why_none_.empty()) why_none_ = "older than the scan before it";
  passOver(located);
  return update;
}

std::optional<dead_reckoning::DeadReckoningUpdate> ScanOdometry::updateInOrder(
    const LocatedScan& located) {
  if (clock_was_set_) goOnInNewTime(located);
  if (shift_ == 0) return updateInTime(located);
  LocatedScan shifted = located;
  shifted.scan.stamp += shift_;
  auto update = updateInTime(shifted);
  if (update) update->stamp -= shift_;
  return update;
}

std::optional<dead_reckoning::DeadReckoningUpdate> ScanOdometry::updateInTime(
    const LocatedScan& located) {
  if (is_new_) reckoner_.reset(located.T_odom_base.value_or(Pose2()));
  const Pose2 T_base_sensor = located.T_base_sensor.value_or(Pose2());
  on_floor_.clear();
  const bool looks_for_floor = floor_ && !located.attitude;
  const scan::Scan scan = evenlyWeighed(located);
  const auto update = looks_for_floor ? matchLeaning(scan, located, T_base_sensor)
                                      : matchLevel(scan, located, T_base_sensor);
  if (!update) return update;
  is_new_ = false;
  const std::int64_t period = std::llround(1e9 * elapsedOf(located));
  if (period > 0) period_ = period;
  before_ = Before{located.scan.stamp, located.scanner, pathOf(located), update->twist};
  return update;
}

std::optional<dead_reckoning::DeadReckoningUpdate> ScanOdometry::matchLevel(
    const scan::Scan& scan, const LocatedScan& located, const Pose2& T_base_sensor) {
  const auto found = match(scan, located, T_base_sensor);
  if (!found) return std::nullopt;
  return reckoner_.commit(*found);
}

// Floor is told from walls by looking back, for which the pose has to be known: the scan is matched
// as it is first, and once more where it turns out to hold floor.
std::optional<dead_reckoning::DeadReckoningUpdate> ScanOdometry::matchLeaning(
    const scan::Scan& scan, const LocatedScan& located, const Pose2& T_base_sensor) {
  auto found = match(scan, located, T_base_sensor);
  if (!found) return std::nullopt;
  auto& finder = finders_.try_emplace(located.scanner, *floor_).first->second;
  on_floor_ = finder.find(scan, found->T_odom_base * T_base_sensor);
  if (std::count(on_floor_.begin(), on_floor_.end(), true) > 0) {
    found = match(motion::without(scan, on_floor_), located, T_base_sensor);
  }
  Update update = reckoner_.commit(*found);
  finder.remember(scan, update.pose.mean * T_base_sensor);
  addUnknownTilt(floor_->max_tilt, scan, T_base_sensor, elapsedOf(located), update);
  return update;
}

}  // namespace sightline::pipeline
