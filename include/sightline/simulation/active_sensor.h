#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "sightline/motion/sensor_head.h"
#include "sightline/simulation/active_sensor_profile.h"
#include "sightline/simulation/detector.h"
#include "sightline/simulation/optical_head.h"
#include "sightline/simulation/random_stream.h"
#include "sightline/simulation/scene.h"
#include "sightline/triangulation/ranger.h"
#include "sightline/world/world.h"

namespace sightline::simulation {

/// A simulated synchronised-scan sensor on its head, which samples without a pause: the device, as
/// far as its photocurrents. triangulation::Ranger makes ranges of them, as it does of a real
/// one's.
class ActiveSensor {
 public:
  /// Pose of what the head is mounted on, at a time [ns]: x straight ahead where the joint is at 0,
  /// z its axis.
  using MountPoseAt = std::function<Eigen::Isometry3d(std::int64_t)>;

  /// Samples from time 0 on. Throws config::Error.
  ActiveSensor(const ActiveSensorProfile& profile, std::uint64_t seed);

  void command(const motion::HeadCommand& command) { head_.command(command); }

  /// Takes all samples up to `time` [ns], and returns the scans that were completed, stamped with
  /// the time of their first sample.
  std::vector<triangulation::RawScan> advance(const world::World& world, std::int64_t time,
                                              const MountPoseAt& T_map_mount);
  /// The same in a world in which things move.
  std::vector<triangulation::RawScan> advance(const WorldAt& world_at, std::int64_t time,
                                              const MountPoseAt& T_map_mount);

  const motion::SensorHead& head() const { return head_; }
  const ActiveSensorProfile& profile() const { return profile_; }
  /// Time of the next sample [ns].
  std::int64_t nextSample() const { return timeOf(samples_); }

 private:
  std::int64_t timeOf(std::int64_t sample) const;
  double trueHeadAngle();
  triangulation::Photocurrents sample(const world::World& world,
                                      const Eigen::Isometry3d& T_map_mount, std::size_t beam);

  ActiveSensorProfile profile_;
  OpticalHead optics_;
  Detector detector_;
  motion::SensorHead head_;
  RandomStream random_;  // of the jitter
  std::normal_distribution<double> normal_;
  std::vector<double> angles_;  // of the beams, in the projection frame [rad]
  std::int64_t samples_ = 0;    // so far
  triangulation::RawScan scan_;
};

}  // namespace sightline::simulation
