#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "sightline/geometry/isometry.h"
#include "sightline/motion/pose_history.h"
#include "sightline/pipeline/transforms.h"

namespace sightline::test {

/// Transforms that a test writes down, each known from its first to its last pose: odom→base,
/// base→sensor, and what follows from these.
class ScriptedTransforms : public pipeline::Transforms {
 public:
  void mount(const std::string& frame, const Eigen::Isometry3d& T_base_sensor) {
    mountings_[frame] = T_base_sensor;
  }
  void mount(const std::string& frame, const geometry::Pose2& T_base_sensor) {
    mount(frame, geometry::inSpace(T_base_sensor));
  }
  /// A mounting that turns.
  void turret(const std::string& frame, std::int64_t stamp, const geometry::Pose2& T_base_sensor) {
    turrets_[frame].add(stamp, T_base_sensor);
  }
  void drive(std::int64_t stamp, const geometry::Pose2& T_odom_base) {
    odometry_.add(stamp, T_odom_base);
  }

  /// Lets something happen, once, right after the next question: transforms of another thread.
  void afterNextQuestion(std::function<void()> happens) { happens_ = std::move(happens); }

  std::optional<Eigen::Isometry3d> at(const std::string& target, const std::string& source,
                                      std::int64_t stamp) const override {
    const auto transform = known(target, source, stamp);
    letHappen();
    return transform;
  }

  std::optional<Newest> newest(const std::string& target,
                               const std::string& source) const override {
    Newest result;
    std::int64_t stamp = std::numeric_limits<std::int64_t>::max();
    if (target == "odom") {
      if (odometry_.empty()) return std::nullopt;
      stamp = odometry_.newest();
    }
    if (source != "base_link" && mountings_.count(source) == 0) {
      const auto turret = turrets_.find(source);
      if (turret == turrets_.end()) return std::nullopt;
      stamp = std::min(stamp, turret->second.newest());
    }
    if (stamp != std::numeric_limits<std::int64_t>::max()) result.stamp = stamp;
    if (const auto transform = known(target, source, stamp)) result.T_target_source = *transform;
    letHappen();
    return result;
  }

 private:
  void letHappen() const {
    if (const auto happens = std::exchange(happens_, nullptr)) happens();
  }

  std::optional<Eigen::Isometry3d> known(const std::string& target, const std::string& source,
                                         std::int64_t stamp) const {
    if (target == "base_link") return mountingAt(source, stamp);
    const auto T_odom_base = odometry_.at(stamp);
    if (target != "odom" || !T_odom_base) return std::nullopt;
    if (source == "base_link") return geometry::inSpace(*T_odom_base);
    const auto T_base_sensor = mountingAt(source, stamp);
    if (!T_base_sensor) return std::nullopt;
    return geometry::inSpace(*T_odom_base) * *T_base_sensor;
  }

  std::optional<Eigen::Isometry3d> mountingAt(const std::string& frame, std::int64_t stamp) const {
    const auto fixed = mountings_.find(frame);
    if (fixed != mountings_.end()) return fixed->second;
    const auto turret = turrets_.find(frame);
    if (turret == turrets_.end()) return std::nullopt;
    const auto pose = turret->second.at(stamp);
    if (!pose) return std::nullopt;
    return geometry::inSpace(*pose);
  }

  mutable std::function<void()> happens_;
  std::map<std::string, Eigen::Isometry3d> mountings_;
  std::map<std::string, motion::PoseHistory> turrets_;
  motion::PoseHistory odometry_{std::numeric_limits<std::int64_t>::max() / 2};
};

}  // namespace sightline::test
