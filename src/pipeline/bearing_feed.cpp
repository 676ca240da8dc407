#include "sightline/pipeline/bearing_feed.h"

#include <algorithm>
#include <cmath>

#include "sightline/geometry/isometry.h"

namespace sightline::pipeline {

namespace {

constexpr std::int64_t kHistory = 10'000'000'000;   // of poses that are kept [ns]
constexpr std::int64_t kWidestGap = 1'000'000'000;  // between two poses [ns]

}  // namespace

BearingFeed::BearingFeed(const BearingTopics& topics, const Transforms& transforms)
    : topics_(topics), transforms_(transforms) {}

void BearingFeed::addPose(const std::string& robot, std::int64_t stamp,
                          const geometry::UncertainPose2& pose) {
  Poses& poses = poses_[robot];
  auto& history = poses.history;
  // One that is not newer would leave no order: the clock was set back, or it came twice.
  if (!history.empty() && stamp <= history.back().stamp) {
    if (stamp > history.front().stamp) return;
    history.clear();
  }
  history.push_back({stamp, pose.mean});
  poses.covariance = pose.covariance;
  while (history.front().stamp < stamp - kHistory) history.pop_front();
}

void BearingFeed::add(ArrivedLook look) {
  looks_.push_back(std::move(look));
}

void BearingFeed::clear() {
  looks_.clear();
  poses_.clear();
  frames_.clear();
}

std::optional<geometry::UncertainPose2> BearingFeed::poseOf(const ArrivedLook& look,
                                                            std::int64_t stamp) const {
  if (topics_.pose_topic.empty()) {
    const auto T_map_sensor = transforms_.at(topics_.map_frame, look.frame, stamp);
    if (!T_map_sensor) return std::nullopt;
    return geometry::UncertainPose2{geometry::inPlane(*T_map_sensor), Eigen::Matrix3d::Zero()};
  }
  const auto found = poses_.find(look.robot);
  if (found == poses_.end()) return std::nullopt;
  const auto& history = found->second.history;
  const auto pose = geometry::poseAt(history.begin(), history.end(), stamp, kWidestGap);
  if (!pose) return std::nullopt;
  return geometry::UncertainPose2{*pose, found->second.covariance};
}

double BearingFeed::turnRateOf(const ArrivedLook& look, const geometry::Pose2& pose) const {
  constexpr std::int64_t kBefore = 50'000'000;
  const auto before = poseOf(look, look.set.stamp - kBefore);
  if (!before) return 0.0;
  return geometry::wrapAngle(pose.theta() - before->mean.theta()) * 1e9 / kBefore;
}

std::vector<BearingFeed::Ready> BearingFeed::ready(std::int64_t now) {
  const std::int64_t patience = std::llround(1e9 * topics_.patience);
  std::vector<Ready> result;
  std::deque<ArrivedLook> waiting;
  for (ArrivedLook& look : looks_) {
    const std::string& frame = frames_.emplace(look.robot, look.frame).first->second;
    const auto pose = poseOf(look, look.set.stamp);
    if (frame != look.frame) {
      result.push_back(
          {look.robot, look.set, "two sensors under one name: " + frame + ", " + look.frame});
    } else if (pose) {
      look.set.T_map_sensor = *pose;
      look.set.turn_rate = turnRateOf(look, pose->mean);
      result.push_back({look.robot, std::move(look.set), ""});
    } else if (now - look.arrival >= patience) {
      result.push_back({look.robot, look.set, "no pose of the sensor at its stamp"});
    } else {
      waiting.push_back(std::move(look));
    }
  }
  looks_ = std::move(waiting);
  std::stable_sort(result.begin(), result.end(),
                   [](const Ready& a, const Ready& b) { return a.set.stamp < b.set.stamp; });
  return result;
}

}  // namespace sightline::pipeline
