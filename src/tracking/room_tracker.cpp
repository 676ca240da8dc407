#include "sightline/tracking/room_tracker.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "sightline/tracking/beam_points.h"
#include "sightline/tracking/pose_filter.h"
#include "sightline/tracking/room_fit.h"
#include "sightline/tracking/wall_finder.h"

namespace sightline::tracking {

namespace {

using geometry::Pose2;

// A beam is on a wall if it ends this close to it: what plaster, skirting boards and a pose in the
// middle of a correction leave open.
constexpr double kWallTolerance = 0.1;
// A pose may be this far past a door when it is first found in the next room [m].
constexpr double kDoorReach = 1.0;
// Fewer beams than this say nothing about whether the room fits.
constexpr std::size_t kEvidence = 20;

// One way of explaining a scan: the pose before it, corrected by the walls found from there.
struct Explanation {
  PoseFilter filter;
  std::vector<WallObservation> walls;
  RoomFit fit;
};

// Beams that speak for an explanation less those that speak against it.
long support(const RoomFit& fit) {
  return static_cast<long>(fit.on_wall) - static_cast<long>(fit.beyond);
}

}  // namespace

class RoomTracker::Impl {
 public:
  Impl(const TrackerConfig& config, world::RoomMap map)
      : config_(config), map_(std::move(map)), finder_(config) {
    config::validate(config);
  }

  const world::RoomMap& map() const { return map_; }
  bool hasPose() const { return filter_.has_value(); }
  void configure(const TrackerConfig& config);
  void setPose(const geometry::UncertainPose2& T_map_base);
  void inflate(double position_sigma, double heading_sigma);
  bool setRoom(const std::string& name);
  void restartClock();
  std::optional<TrackerUpdate> update(const scan::Scan& scan, const Pose2& T_odom_base,
                                      const Pose2& T_base_sensor);

 private:
  void predict(const Pose2& T_odom_base);
  Explanation explain(const PoseFilter& prior, const scan::Scan& scan, const Pose2& T_base_sensor,
                      const Sweep& sweep) const;
  Explanation explainBest(const scan::Scan& scan, const Pose2& T_base_sensor) const;
  std::vector<WallIndex> wallsInSight() const;
  void applyWalls(PoseFilter& filter, std::vector<WallObservation>& walls) const;
  bool contradictsPrediction(const Explanation& explanation) const;
  void changeRoom();
  bool hasDoors(std::size_t room) const;
  TrackerState judge(const RoomFit& fit);
  TrackerUpdate report(const scan::Scan& scan, const Pose2& T_odom_base, Explanation explanation);

  TrackerConfig config_;
  world::RoomMap map_;
  WallFinder finder_;
  std::optional<PoseFilter> filter_;
  std::size_t room_ = 0;
  std::optional<Pose2> T_odom_base_;  // at the last scan
  std::int64_t stamp_ = 0;            // of the last scan
  int misfits_ = 0;                   // scans in a row that did not fit the room
};

void RoomTracker::Impl::configure(const TrackerConfig& config) {
  config::validate(config);
  config_ = config;
  finder_ = WallFinder(config);
  if (filter_) filter_->configure(config);
}

void RoomTracker::Impl::setPose(const geometry::UncertainPose2& T_map_base) {
  filter_.emplace(config_, T_map_base);
  const Eigen::Vector2d position = T_map_base.mean.translation();
  room_ = map_.roomAt(position).value_or(map_.nearestRoom(position));
  misfits_ = 0;
  restartClock();
}

void RoomTracker::Impl::restartClock() {
  T_odom_base_.reset();
  stamp_ = 0;
}

void RoomTracker::Impl::inflate(double position_sigma, double heading_sigma) {
  if (filter_) filter_->inflate(position_sigma, heading_sigma);
}

bool RoomTracker::Impl::setRoom(const std::string& name) {
  const auto room = map_.find(name);
  if (!room) return false;
  room_ = *room;
  inflate(config_.threshold_position_sigma, config_.threshold_heading_sigma);
  return true;
}

void RoomTracker::Impl::predict(const Pose2& T_odom_base) {
  if (T_odom_base_) filter_->predict(geometry::between(*T_odom_base_, T_odom_base));
  T_odom_base_ = T_odom_base;
}

void RoomTracker::Impl::applyWalls(PoseFilter& filter, std::vector<WallObservation>& walls) const {
  // The best-seen wall first: it leaves the others the least room for error.
  std::vector<std::size_t> order(walls.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return walls[a].accepted_beams.size() > walls[b].accepted_beams.size();
  });
  for (const std::size_t i : order) {
    WallObservation& wall = walls[i];
    if (!wall.accepted) continue;
    const auto innovation = filter.innovation(
        wall.fit, map_.rooms()[wall.room].walls[wall.wall].segment.line(), wall.motion_jacobian);
    wall.innovation = innovation.value;
    wall.nis = innovation.nis;
    wall.accepted = innovation.nis <= config_.wall.max_nis;
    if (wall.accepted) filter.update(innovation);
  }
}

std::vector<WallIndex> RoomTracker::Impl::wallsInSight() const {
  std::vector<std::size_t> rooms{room_};
  if (config_.neighbours) {
    for (const world::Door& door : map_.doors()) {
      for (const std::size_t side : {0U, 1U}) {
        const bool leads_there = door.rooms[1 - side] == room_;
        const std::size_t other = door.rooms[side];
        if (leads_there && std::find(rooms.begin(), rooms.end(), other) == rooms.end()) {
          rooms.push_back(other);
        }
      }
    }
  }
  std::vector<WallIndex> walls;
  for (const std::size_t room : rooms) {
    for (std::size_t wall = 0; wall < map_.rooms()[room].walls.size(); ++wall) {
      walls.push_back({room, wall});
    }
  }
  return walls;
}

Explanation RoomTracker::Impl::explain(const PoseFilter& prior, const scan::Scan& scan,
                                       const Pose2& T_base_sensor, const Sweep& sweep) const {
  Explanation explanation{prior, finder_.find(prior, map_, wallsInSight(), sweep), {}};
  explanation.filter.beginSweep(sweep.motion_covariance);
  applyWalls(explanation.filter, explanation.walls);
  explanation.fit = fitToRoom(scan, explanation.filter.pose().mean * T_base_sensor,
                              map_.rooms()[room_], kWallTolerance);
  return explanation;
}

bool RoomTracker::Impl::contradictsPrediction(const Explanation& explanation) const {
  const RoomFit& fit = explanation.fit;
  if (fit.on_wall + fit.beyond >= kEvidence && fit.quality() < config_.slip.min_quality)
    return true;
  // Walls well seen and yet refused: gates must not lock out for ever what contradicts a wrong
  // prediction.
  std::size_t accepted = 0;
  std::size_t refused = 0;
  for (const WallObservation& wall : explanation.walls) {
    (wall.accepted ? accepted : refused) += wall.accepted_beams.size();
  }
  return refused > accepted;
}

Explanation RoomTracker::Impl::explainBest(const scan::Scan& scan,
                                           const Pose2& T_base_sensor) const {
  const double sigma = config_.method == Method::kPlain ? config_.plain_point_sigma : 0.0;
  const Sweep sweep = readSweep(scan, T_base_sensor, config_.odometry, sigma);
  Explanation as_predicted = explain(*filter_, scan, T_base_sensor, sweep);
  if (!contradictsPrediction(as_predicted)) return as_predicted;
  PoseFilter slipped = *filter_;
  slipped.inflate(config_.slip.position_sigma, config_.slip.heading_sigma);
  Explanation as_slip = explain(slipped, scan, T_base_sensor, sweep);
  const bool better = support(as_slip.fit) > support(as_predicted.fit);
  return better ? as_slip : as_predicted;
}

void RoomTracker::Impl::changeRoom() {
  const Eigen::Vector2d position = filter_->pose().mean.translation();
  const auto entered = map_.roomAt(position, room_);
  if (!entered || *entered == room_) return;
  const world::Door* door = map_.doorBetween(room_, *entered, position);
  // Nobody walks through walls: a pose that does is wrong, and the room it comes from is the one to
  // correct it by.
  if (!door && hasDoors(room_)) return;
  if (door && (door->centre_map - position).norm() > 0.5 * door->width + kDoorReach) return;
  room_ = *entered;
  if (door && door->threshold) {
    filter_->inflate(config_.threshold_position_sigma, config_.threshold_heading_sigma);
  }
}

bool RoomTracker::Impl::hasDoors(std::size_t room) const {
  return std::any_of(map_.doors().begin(), map_.doors().end(), [&](const world::Door& door) {
    return door.rooms[0] == room || door.rooms[1] == room;
  });
}

TrackerState RoomTracker::Impl::judge(const RoomFit& fit) {
  const bool tells = fit.on_wall + fit.beyond >= kEvidence;
  const bool outside =
      map_.rooms()[room_].distance(filter_->pose().mean.translation()) > kDoorReach;
  if (tells || outside) {
    misfits_ = outside || fit.quality() < config_.lost_quality ? misfits_ + 1 : 0;
  }
  if (misfits_ >= config_.lost_scans) return TrackerState::kLost;
  const Eigen::Matrix4d P = filter_->covariance();
  const double position = std::sqrt(std::max(P(0, 0), P(1, 1)));
  const bool vague = position > config_.degraded_position_sigma ||
                     std::sqrt(P(2, 2)) > config_.degraded_heading_sigma;
  return vague || misfits_ > 0 ? TrackerState::kDegraded : TrackerState::kTracking;
}

TrackerUpdate RoomTracker::Impl::report(const scan::Scan& scan, const Pose2& T_odom_base,
                                        Explanation explanation) {
  TrackerUpdate update;
  update.stamp = scan.stamp;
  update.pose = filter_->pose();
  update.T_map_odom = update.pose.mean * T_odom_base.inverse();
  update.odometry_scale = filter_->scale();
  update.odometry_scale_sigma = filter_->scaleSigma();
  update.state = judge(explanation.fit);
  update.quality = explanation.fit.quality();
  update.covariance_valid = update.state != TrackerState::kLost && config_.method == Method::kFull;
  update.room = map_.rooms()[room_].name;
  update.walls = std::move(explanation.walls);
  return update;
}

std::optional<TrackerUpdate> RoomTracker::Impl::update(const scan::Scan& scan,
                                                       const Pose2& T_odom_base,
                                                       const Pose2& T_base_sensor) {
  if (!filter_ || scan.stamp < stamp_ || !T_odom_base.isFinite() || !T_base_sensor.isFinite()) {
    return std::nullopt;
  }
  stamp_ = scan.stamp;
  predict(T_odom_base);
  Explanation explanation = explainBest(scan, T_base_sensor);
  filter_ = explanation.filter;
  if (config_.method == Method::kPlain) filter_->applyFloor();
  TrackerUpdate result = report(scan, T_odom_base, std::move(explanation));
  changeRoom();
  return result;
}

RoomTracker::RoomTracker(const TrackerConfig& config, world::RoomMap map)
    : impl_(std::make_unique<Impl>(config, std::move(map))) {}
RoomTracker::~RoomTracker() = default;
RoomTracker::RoomTracker(RoomTracker&&) noexcept = default;
RoomTracker& RoomTracker::operator=(RoomTracker&&) noexcept = default;

void RoomTracker::configure(const TrackerConfig& config) {
  impl_->configure(config);
}

void RoomTracker::setPose(const geometry::UncertainPose2& T_map_base) {
  impl_->setPose(T_map_base);
}

void RoomTracker::inflate(double position_sigma, double heading_sigma) {
  impl_->inflate(position_sigma, heading_sigma);
}

bool RoomTracker::setRoom(const std::string& name) {
  return impl_->setRoom(name);
}

void RoomTracker::restartClock() {
  impl_->restartClock();
}

std::optional<TrackerUpdate> RoomTracker::update(const scan::Scan& scan, const Pose2& T_odom_base,
                                                 const Pose2& T_base_sensor) {
  return impl_->update(scan, T_odom_base, T_base_sensor);
}

bool RoomTracker::hasPose() const {
  return impl_->hasPose();
}

const world::RoomMap& RoomTracker::map() const {
  return impl_->map();
}

}  // namespace sightline::tracking
