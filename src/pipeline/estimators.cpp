#include "sightline/pipeline/estimators.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sightline/motion/sweep.h"

namespace sightline::pipeline {

using geometry::Pose2;

namespace {

// Uncertainty of the motion over a break in the odometry, or while the clock is set [m, rad].
constexpr double kBridgedPosition = 0.1;
constexpr double kBridgedHeading = 0.1;

// A start that cannot be: people write degrees, and mix up maps.
void checkStart(const RoomsConfig& rooms, const world::RoomMap& map) {
  const geometry::Pose2 start = *rooms.initial_pose;
  const world::Room& nearest = map.rooms()[map.nearestRoom(start.translation())];
  const double outside = nearest.distance(start.translation());
  if (outside <= std::max(1.0, 3.0 * rooms.initial_sigma[0])) return;
  throw config::Error(rooms.map, 0, "initial_pose",
                      fmt::format("({:.2f}, {:.2f}) lies {:.1f} m outside every room; the nearest "
                                  "is '{}'",
                                  start.x(), start.y(), outside, nearest.name));
}

void flagBreak(tracking::TrackerUpdate& update) {
  if (update.state == tracking::TrackerState::kTracking) {
    update.state = tracking::TrackerState::kDegraded;
  }
}

// Scans and odometry turn apart: one of them is mirrored.
void flagTurns(dead_reckoning::DeadReckoningUpdate& update) {
  using dead_reckoning::MatchState;
  if (update.state == MatchState::kMatched) update.state = MatchState::kAmbiguous;
}

}  // namespace

Estimators::Estimators(const EstimatorsConfig& config, const EstimatorSet& set)
    : config_(config), set_(set) {
  config::validate(config_.lines);
  if (set.rooms) {
    if (!config_.rooms) throw config::Error("", 0, "rooms", "the settings do not say which");
    rooms_.emplace(config_.rooms->tracker, world::RoomMap::readFile(config_.rooms->map));
    if (config_.rooms->initial_pose) {
      checkStart(*config_.rooms, rooms_->map());
      rooms_->setPose(config_.rooms->start());
    }
  }
  // A scanner that leans is only told from walls by where it has been.
  if (set.odometry || config_.input.leans) {
    const auto floor = config_.input.leans ? std::make_optional(config_.input.floor) : std::nullopt;
    odometry_.emplace(config_.odometry.value_or(ScanOdometryConfig()), floor);
  }
  if (set.features) features_.emplace(config_.features);
}

void Estimators::configureLines(const LinesConfig& config) {
  config::validate(config);
  config_.lines = config;
  extractors_.clear();
}

Estimates Estimators::take(LocatedScan located) {
  if (located.clock_restarted) {
    rooms_restart_ = true;
    if (odometry_) odometry_->restartClock();
    if (features_) features_->restart();
  }
  Estimates estimates;
  estimates.located = std::move(located);
  removeFloor(estimates.located);
  if (odometry_) reckon(estimates);
  if (!estimates.located.motion_known) addMotion(estimates);
  if (set_.lines) extract(estimates);
  if (features_ && estimates.lines) {
    estimates.features = features_->take(estimates.located, estimates.odometry, *estimates.lines);
  }
  if (rooms_) track(estimates);
  return estimates;
}

// The odometry tells a clock that was set from a recording that is played again.
void Estimators::restartRooms(const Pose2& T_odom_base) {
  rooms_restart_ = false;
  const bool goes_on = T_odom_base_ && isSamePlace(*T_odom_base_, T_odom_base);
  if (config_.rooms->initial_pose && !goes_on) {
    rooms_->setPose(config_.rooms->start());
  } else {
    rooms_->restartClock();
    rooms_->inflate(kBridgedPosition, kBridgedHeading);
  }
}

// Removes the floor by a measured attitude; without one, the odometry looks for the floor.
void Estimators::removeFloor(LocatedScan& located) const {
  if (!config_.input.leans || !located.attitude) return;
  const auto on_floor = motion::beamsOnFloor(config_.input.floor, located.scan, *located.attitude);
  located.scan = motion::without(motion::levelled(located.scan, *located.attitude), on_floor);
}

// One scanner of unknown mounting is taken for the base, until one is known.
bool Estimators::isPlaced(const LocatedScan& located) {
  if (located.T_base_sensor) {
    // The poses found so far were of the scanner, not of the base.
    if (!is_mounting_known_) odometry_->reset();
    is_mounting_known_ = true;
    return true;
  }
  if (is_mounting_known_) return false;
  if (!taken_for_base_) taken_for_base_ = located.scanner;
  return *taken_for_base_ == located.scanner;
}

void Estimators::reckon(Estimates& estimates) {
  LocatedScan& located = estimates.located;
  if (!isPlaced(located)) {
    odometry_->passOver(located);
    estimates.no_odometry = located.no_odometry;
    return;
  }
  estimates.odometry = odometry_->update(located);
  if (!estimates.odometry) estimates.no_odometry = odometry_->whyNone();
  if (estimates.odometry && located.turns_opposite) flagTurns(*estimates.odometry);
  if (!odometry_->beamsOnFloor().empty()) {
    located.scan = motion::without(located.scan, odometry_->beamsOnFloor());
  }
}

// Takes the velocity that the dead reckoner found where no odometry tells how the sensor moved.
void Estimators::addMotion(Estimates& estimates) const {
  const auto& update = estimates.odometry;
  if (!update || update->state == dead_reckoning::MatchState::kInitial) return;
  scan::Scan& scan = estimates.located.scan;
  const double duration = scan.duration();
  const Pose2 T_base_sensor = estimates.located.T_base_sensor.value_or(Pose2());
  scan.setSensorMotion(motion::sweepMotion(
      *scan.geometry(), Pose2::exp(duration * update->twist.mean), T_base_sensor));
  const Eigen::Matrix3d to_sensor = T_base_sensor.inverse().adjoint();
  scan.motion_noise.drift =
      duration * duration * to_sensor * update->twist.covariance * to_sensor.transpose();
}

Estimators::Extractor& Estimators::extractorOf(std::size_t scanner) {
  while (extractors_.size() <= scanner) {
    const auto& config = config_.lines.extractor;
    extractors_.push_back({lines::LineExtractor(config), lines::PlainExtractor(config)});
  }
  return extractors_[scanner];
}

void Estimators::extract(Estimates& estimates) {
  const scan::Scan& scan = estimates.located.scan;
  Extractor& extractor = extractorOf(estimates.located.scanner);
  estimates.lines.emplace();
  if (config_.lines.method == LineMethod::kPlain) {
    estimates.lines->segments = extractor.plain.extract(scan);
  } else {
    estimates.lines->segments = extractor.full.extract(scan);
    estimates.lines->arcs = extractor.full.arcs();
  }
}

// The dead reckoner tells the way where wheels are not to.
std::optional<Pose2> Estimators::odometryOf(const Estimates& estimates) const {
  const bool by_scans = config_.input.feed.odometry_source == OdometrySource::kNone;
  if (by_scans && estimates.odometry) return estimates.odometry->pose.mean;
  return estimates.located.T_odom_base;
}

void Estimators::track(Estimates& estimates) {
  const LocatedScan& located = estimates.located;
  const auto T_odom_base = odometryOf(estimates);
  if (!T_odom_base || !located.T_base_sensor) return;
  if (rooms_restart_) restartRooms(*T_odom_base);
  T_odom_base_ = T_odom_base;
  if (located.odometry_broke) rooms_->inflate(kBridgedPosition, kBridgedHeading);
  const Pose2 T_path_base = located.T_path_base.value_or(*T_odom_base);
  estimates.rooms = rooms_->update(located.scan, T_path_base, *located.T_base_sensor);
  if (!estimates.rooms) return;
  estimates.rooms->T_map_odom = estimates.rooms->pose.mean * T_odom_base->inverse();
  if (located.odometry_broke || located.turns_opposite) flagBreak(*estimates.rooms);
}

}  // namespace sightline::pipeline
