#include "sightline/pipeline/scan_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "sightline/geometry/isometry.h"
#include "sightline/pipeline/stamp_watch.h"

namespace sightline::pipeline {

using geometry::Pose2;

namespace {

constexpr struct {
  // Silence after which a source is not waited for [ns].
  std::int64_t silence = 1'000'000'000;
  // Older than this, the newest motion says nothing about the present one [ns].
  std::int64_t oldest_motion = 500'000'000;
  // The plane of a scanner may be so far from level [rad]: beyond it, ranges along the ground and
  // along the beam differ by more than 6 %.
  double most_tilt = 0.35;
  // A mounting that differs by more is not fixed [m, and as an entry of a rotation].
  double fixed = 1e-4;
} kConstants;

double tiltOf(const Eigen::Isometry3d& T_base_sensor) {
  return std::acos(std::min(1.0, std::abs(T_base_sensor.linear()(2, 2))));
}

ScanLocator::Outcome dropped(std::string reason) {
  ScanLocator::Outcome outcome;
  outcome.reason = std::move(reason);
  return outcome;
}

ScanLocator::Outcome waiting() {
  ScanLocator::Outcome outcome;
  outcome.waits = true;
  return outcome;
}

}  // namespace

ScanLocator::ScanLocator(const FeedConfig& config, const Frames& frames, const FeedNeeds& needs,
                         const Transforms& transforms)
    : config_(config),
      frames_(frames),
      needs_(needs),
      transforms_(transforms),
      sweep_motion_(config),
      bridge_(config.odometry_limits) {
  checkSectors(config_.body);
  if (config_.odometry_source != OdometrySource::kAutomatic) source_ = config_.odometry_source;
}

// What comes late, and out of order, does not end the history.
void ScanLocator::addOdometry(std::int64_t stamp, const Pose2& T_odom_base) {
  const bool is_late = !odometry_.empty() && stamp < odometry_.newest() &&
                       odometry_.newest() - stamp < StampWatch::kSetBack;
  if (!is_late) odometry_.add(stamp, T_odom_base);
}

void ScanLocator::restartClock(std::int64_t stamp) {
  bridge_.restartClock();
  if (!odometry_.empty() && odometry_.newest() > stamp + kConstants.silence) odometry_.clear();
  const auto newest_imu = imu_.newest();
  if (newest_imu && *newest_imu > stamp + kConstants.silence) imu_ = ImuHistory();
}

ScanLocator::Outcome ScanLocator::locate(const ArrivedScan& arrived, const Patience& patience,
                                         std::optional<std::int64_t> before) {
  std::optional<Eigen::Isometry3d> T_base_carried;
  const Known mounting = findMounting(arrived, patience, T_base_carried);
  if (mounting == Known::kWait) return waiting();
  if (T_base_carried && tiltOf(*T_base_carried) > kConstants.most_tilt) {
    return dropped(fmt::format("its plane is not level: {} is tilted by {:.0f} degrees in {}",
                               arrived.carriedFrame(), geometry::degrees(tiltOf(*T_base_carried)),
                               frames_.base));
  }
  const Known odometry = findOdometry(arrived, patience);
  if (odometry == Known::kWait || findImu(arrived, patience) == Known::kWait) return waiting();
  Outcome outcome;
  outcome.located.emplace();
  place(arrived, T_base_carried, *outcome.located);
  if (odometry == Known::kYes) {
    if (needs_.mounting) followWheels(arrived, *outcome.located);
    addMotion(arrived, -arrived.odometry_shift, *outcome.located);
  } else if (const auto lag = lagOf(arrived); lag && odometry == Known::kNot) {
    addMotion(arrived, *lag, *outcome.located);
  }
  explain(arrived, odometry, *outcome.located);
  addInertial(arrived, before, *outcome.located);
  return outcome;
}

ScanLocator::Known ScanLocator::findMounting(const ArrivedScan& arrived, const Patience& patience,
                                             std::optional<Eigen::Isometry3d>& T_base_carried) {
  if (!needs_.mounting) return Known::kNot;
  const std::string& frame = arrived.carriedFrame();
  // The newest first: transforms that come in between must not look like ones that began later.
  const auto newest = transforms_.newest(frames_.base, frame);
  T_base_carried = transforms_.at(frames_.base, frame, arrived.scan.stamp);
  if (T_base_carried) return remember(frame, *T_base_carried);
  const auto known = mountings_.find(frame);
  if (known == mountings_.end() && !newest) return waitForFirst(frame, patience);
  const bool began_later = newest && newest->stamp.value_or(0) > arrived.scan.stamp;
  if (patience.usual && !began_later) return Known::kWait;
  if (known != mountings_.end() && !known->second.is_fixed) return Known::kNot;
  T_base_carried =
      known != mountings_.end() ? known->second.T_base_carried : newest->T_target_source;
  return Known::kYes;
}

ScanLocator::Known ScanLocator::remember(const std::string& frame,
                                         const Eigen::Isometry3d& T_base_carried) {
  const auto [known, is_new] = mountings_.try_emplace(frame, Mounting{T_base_carried, true});
  if (!is_new && !known->second.T_base_carried.isApprox(T_base_carried, kConstants.fixed)) {
    known->second = {T_base_carried, false};
  }
  return Known::kYes;
}

// Waits for a source once: one that was waited for in vain is not waited for again.
ScanLocator::Known ScanLocator::waitForFirst(const std::string& what, const Patience& patience) {
  if (given_up_.count(what) > 0) return Known::kNot;
  if (patience.start) return Known::kWait;
  given_up_.insert(what);
  return Known::kNot;
}

// Chooses automatically: transforms go before the topic, and the choice stays, so that no step is
// between poses of two origins.
void ScanLocator::chooseSource(const std::string& frame) {
  if (source_) return;
  if (transforms_.newest(frames_.odom, frame)) {
    source_ = OdometrySource::kTransforms;
  } else if (!odometry_.empty()) {
    source_ = OdometrySource::kTopic;
  }
}

std::optional<std::int64_t> ScanLocator::newestOdometry(const std::string& frame) const {
  if (source_ == OdometrySource::kTransforms) {
    const auto newest = transforms_.newest(frames_.odom, frame);
    if (!newest) return std::nullopt;
    return newest->stamp.value_or(std::numeric_limits<std::int64_t>::max());
  }
  if (odometry_.empty()) return std::nullopt;
  return odometry_.newest();
}

ScanLocator::Known ScanLocator::findOdometry(const ArrivedScan& arrived, const Patience& patience) {
  if (!needs_.odometry || source_ == OdometrySource::kNone) return Known::kNot;
  const std::string& frame = arrived.carriedFrame();
  chooseSource(frame);
  const std::string what = "odometry";
  if (!source_) return waitForFirst(what, patience);
  const std::int64_t stamp = arrived.scan.stamp + arrived.odometry_shift;
  const std::int64_t end = std::max(stamp, arrived.scan.end() + arrived.odometry_shift);
  // The newest first, as with the mounting.
  const auto newest = newestOdometry(frame);
  if (T_odom_carried(frame, stamp) && T_odom_carried(frame, end)) return Known::kYes;
  if (!newest) return waitForFirst(what, patience);
  if (*newest >= end) return Known::kNever;
  return patience.usual && end - *newest < kConstants.silence ? Known::kWait : Known::kNot;
}

ScanLocator::Known ScanLocator::findImu(const ArrivedScan& arrived,
                                        const Patience& patience) const {
  const auto newest = imu_.newest();
  const std::int64_t end = arrived.scan.end();
  if (!newest || *newest >= end) return newest ? Known::kYes : Known::kNot;
  return patience.usual && end - *newest < kConstants.silence ? Known::kWait : Known::kNot;
}

std::optional<Pose2> ScanLocator::T_odom_base(std::int64_t stamp) const {
  if (source_ == OdometrySource::kTopic) return odometry_.at(stamp);
  const auto transform = transforms_.at(frames_.odom, frames_.base, stamp);
  if (!transform) return std::nullopt;
  return geometry::inPlane(*transform);
}

// Pose of what moves with the sensor's mount; by the topic, that is the base itself.
std::optional<Eigen::Isometry3d> ScanLocator::T_odom_carried(const std::string& frame,
                                                             std::int64_t stamp) const {
  if (source_ == OdometrySource::kTransforms) return transforms_.at(frames_.odom, frame, stamp);
  const auto pose = odometry_.at(stamp);
  if (!pose) return std::nullopt;
  const auto mounting = mountings_.find(frame);
  const Eigen::Isometry3d T_odom_base = geometry::inSpace(*pose);
  return mounting == mountings_.end() ? T_odom_base : T_odom_base * mounting->second.T_base_carried;
}

// Mirrors what hangs upside down, so that all that follows is in the plane.
void ScanLocator::place(const ArrivedScan& arrived,
                        const std::optional<Eigen::Isometry3d>& T_base_carried,
                        LocatedScan& located) {
  located.scanner = arrived.scanner;
  const auto orientation =
      T_base_carried ? T_base_carried : T_odom_carried(arrived.carriedFrame(), arrived.scan.stamp);
  located.upside_down = orientation && orientation->linear()(2, 2) < 0.0;
  located.scan = located.upside_down ? scan::mirrored(arrived.scan, mirroredGeometry(arrived.scan))
                                     : arrived.scan;
  located.motion_known = arrived.scan.duration() == 0.0;
  if (!T_base_carried) return;
  located.T_base_sensor = geometry::inPlane(*T_base_carried);
  maskBody(arrived, located);
  if (!arrived.head) return;
  const auto head = located.upside_down ? motion::mirrored(*arrived.head) : *arrived.head;
  located.T_base_sensor = *located.T_base_sensor * head.T_mount_sensor(0);
}

void ScanLocator::maskBody(const ArrivedScan& arrived, LocatedScan& located) const {
  const auto sectors = config_.body.find(arrived.carriedFrame());
  if (sectors == config_.body.end()) return;
  pipeline::maskBody(sectors->second, *located.T_base_sensor, located.scan);
}

void ScanLocator::followWheels(const ArrivedScan& arrived, LocatedScan& located) {
  const std::int64_t stamp = located.scan.stamp;
  const auto pose_at = [this, shift = arrived.odometry_shift](std::int64_t time) {
    return T_odom_base(time + shift);
  };
  located.T_odom_base = pose_at(stamp);
  if (!located.T_odom_base) return;
  const auto step = bridge_.follow(stamp, pose_at, arrived.elapsed);
  located.T_path_base = step.T_path_base;
  located.odometry_broke = step.is_broken;
}

// Lag of odometry that does not reach the end of the sweep, and yet tells how the sensor has been
// moving a moment ago.
std::optional<std::int64_t> ScanLocator::lagOf(const ArrivedScan& arrived) const {
  if (!needs_.odometry || !source_ || source_ == OdometrySource::kNone) return std::nullopt;
  const auto newest = newestOdometry(arrived.carriedFrame());
  if (!newest) return std::nullopt;
  const std::int64_t lag = arrived.scan.end() - *newest;
  if (lag <= 0 || lag > kConstants.oldest_motion) return std::nullopt;
  return lag;
}

void ScanLocator::addMotion(const ArrivedScan& arrived, std::int64_t lag,
                            LocatedScan& located) const {
  const auto carried = [&](std::int64_t stamp) -> std::optional<Pose2> {
    const auto pose = T_odom_carried(arrived.carriedFrame(), stamp);
    if (!pose) return std::nullopt;
    return geometry::inPlane(*pose);
  };
  const auto base = [this](std::int64_t stamp) { return T_odom_base(stamp); };
  sweep_motion_.add(arrived, carried, base, lag, located);
}

// Whether the odometry that there is ends long before a scan.
bool ScanLocator::isOver(const ArrivedScan& arrived) const {
  const auto newest = newestOdometry(arrived.carriedFrame());
  return newest && *newest < arrived.scan.stamp - kConstants.silence;
}

void ScanLocator::explain(const ArrivedScan& arrived, Known odometry, LocatedScan& located) const {
  located.before_odometry = odometry == Known::kNever;
  if (located.before_odometry) {
    located.no_odometry = "it is from before the odometry began";
  } else if (!located.T_base_sensor) {
    located.no_odometry =
        fmt::format("no transform from {} to {} at its time", frames_.base, arrived.carriedFrame());
  } else if (!located.T_odom_base) {
    located.no_odometry =
        fmt::format("{} from {} to {} {}", isOver(arrived) ? "the odometry" : "no odometry",
                    frames_.odom, frames_.base, isOver(arrived) ? "ends before it" : "at its time");
  }
}

void ScanLocator::addInertial(const ArrivedScan& arrived, std::optional<std::int64_t> before,
                              LocatedScan& located) const {
  const std::int64_t stamp = arrived.scan.stamp;
  if (before) located.turn = imu_.turn(*before, stamp);
  const auto first = imu_.attitude(stamp);
  const auto last = imu_.attitude(arrived.scan.end());
  if (!first || !last) return;
  const double yaw = located.T_base_sensor ? located.T_base_sensor->theta() : 0.0;
  located.attitude = motion::SweepAttitude{first->seenFrom(yaw), last->seenFrom(yaw)};
}

std::shared_ptr<const scan::ScanGeometry> ScanLocator::mirroredGeometry(const scan::Scan& scan) {
  if (scan.geometry() != geometry_) {
    geometry_ = scan.geometry();
    mirrored_geometry_ = geometry_->mirrored();
  }
  return mirrored_geometry_;
}

}  // namespace sightline::pipeline
