#include "sightline/mapping/replay.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sightline::mapping {

namespace {

constexpr struct {
  double position = 0.25;     // from the path that is kept: more, and a robot meets door frames [m]
  double heading = 0.1745;    // 10° [rad]
  double least_right = 0.98;  // share of the scans that a map has to keep
  double longest_lost = 3.0;  // [s]
  double shortest_lost = 1.0;  // place that is worth a word [s]
  std::int64_t gap = 1'000'000'000;
} kReplay{};

pipeline::EstimatorsConfig started(pipeline::EstimatorsConfig config,
                                   const std::vector<geometry::StampedPose2>& path) {
  if (config.rooms && !path.empty()) config.rooms->initial_pose = path.front().pose;
  return config;
}

std::optional<geometry::Pose2> at(const std::vector<geometry::StampedPose2>& poses,
                                  std::int64_t stamp) {
  return geometry::poseAt(poses.begin(), poses.end(), stamp, kReplay.gap);
}

}  // namespace

Replay::Replay(pipeline::EstimatorsConfig config, std::vector<geometry::StampedPose2> path,
               std::vector<geometry::StampedPose2> odometry)
    : path_(std::move(path)), tracker_(started(std::move(config), path_), std::move(odometry)) {}

void Replay::take(pipeline::LocatedScan located) {
  if (located.scanner != 0) return;
  const std::int64_t stamp = located.scan.stamp;
  const auto truth = at(path_, stamp);
  if (!truth) return;
  const pipeline::Estimates estimates = tracker_.take(std::move(located));
  ++scans_;
  if (!estimates.rooms) return judge(stamp, geometry::Pose2(1e3, 0.0, 0.0), *truth);
  count(*estimates.rooms);
  judge(stamp, geometry::between(*truth, estimates.rooms->pose.mean), *truth);
}

void Replay::judge(std::int64_t stamp, const geometry::Pose2& difference,
                   const geometry::Pose2& truth) {
  const double away = difference.translation().norm();
  const bool is_right = away <= kReplay.position && std::abs(difference.theta()) <= kReplay.heading;
  most_ = std::max(most_, away);
  last_ = stamp;
  if (is_right) {
    ++right_;
    sum_ += away;
    finish();
  } else if (!is_lost_) {
    is_lost_ = true;
    const double begin = 1e-9 * static_cast<double>(stamp - path_.front().stamp);
    lost_.push_back({begin, 0.0, truth.translation()});
  }
}

void Replay::finish() {
  if (!is_lost_) return;
  is_lost_ = false;
  LostPlace& place = lost_.back();
  place.seconds = 1e-9 * static_cast<double>(last_ - path_.front().stamp) - place.begin;
}

void Replay::count(const tracking::TrackerUpdate& update) {
  for (const tracking::WallUpdate& wall : update.walls) {
    WallUse& use = walls_[{wall.room, wall.wall}];
    if (wall.refusal == tracking::WallRefusal::kOutsideGate) ++use.refused;
    if (!wall.accepted() || !wall.innovation) continue;
    ++use.used;
    use.residual += wall.innovation->value[0];
  }
}

double Replay::rightShare() const {
  return scans_ == 0 ? 0.0 : static_cast<double>(right_) / static_cast<double>(scans_);
}

double Replay::meanDifference() const {
  return right_ == 0 ? 0.0 : sum_ / static_cast<double>(right_);
}

bool Replay::isGood() const {
  return scans_ > 0 && rightShare() >= kReplay.least_right &&
         std::none_of(lost_.begin(), lost_.end(),
                      [](const LostPlace& place) { return place.seconds > kReplay.longest_lost; });
}

std::vector<LostPlace> Replay::lostPlaces() const {
  std::vector<LostPlace> places;
  std::copy_if(lost_.begin(), lost_.end(), std::back_inserter(places),
               [](const LostPlace& place) { return place.seconds >= kReplay.shortest_lost; });
  std::stable_sort(places.begin(), places.end(),
                   [](const LostPlace& a, const LostPlace& b) { return a.seconds > b.seconds; });
  return places;
}

}  // namespace sightline::mapping
