#include "sightline/simulation/active_sensor.h"

#include <cmath>
#include <utility>

namespace sightline::simulation {

namespace {

const ActiveSensorProfile& checkedProfile(const ActiveSensorProfile& profile) {
  profile.check("");
  return profile;
}

}  // namespace

ActiveSensor::ActiveSensor(const ActiveSensorProfile& profile, std::uint64_t seed)
    : profile_(checkedProfile(profile)),
      optics_(profile.sensor.intrinsics, profile.optics),
      detector_(profile.sensor.noise_current, profile.sensor.intrinsics.detector_length,
                profile.bandwidth, profile.sensor.scan.sample_rate, seed),
      head_(profile.head),
      random_(randomStream(seed, 4)),
      angles_(profile.sensor.scan.geometry(profile.sensor.origin.projected_vergence)->angles()) {}

std::int64_t ActiveSensor::timeOf(std::int64_t sample) const {
  return std::llround(1e9 * static_cast<double>(sample) / profile_.sensor.scan.sample_rate);
}

double ActiveSensor::trueHeadAngle() {
  if (profile_.jitter == 0.0) return head_.angle();
  return head_.angle() + profile_.jitter * normal_(random_);
}

triangulation::Photocurrents ActiveSensor::sample(const world::World& world,
                                                  const Eigen::Isometry3d& T_map_mount,
                                                  std::size_t beam) {
  const Eigen::Isometry3d T_map_head =
      T_map_mount * Eigen::AngleAxisd(trueHeadAngle(), Eigen::Vector3d::UnitZ());
  const Eigen::Vector2d origin = profile_.sensor.origin.position();
  const Eigen::Isometry3d T_map_projection =
      T_map_head * Eigen::Translation3d(origin.x(), origin.y(), 0.0);
  return detector_.measure(optics_.look(world, T_map_projection, angles_[beam]));
}

std::vector<triangulation::RawScan> ActiveSensor::advance(const world::World& world,
                                                          std::int64_t time,
                                                          const MountPoseAt& T_map_mount) {
  return advance(still(world), time, T_map_mount);
}

std::vector<triangulation::RawScan> ActiveSensor::advance(const WorldAt& world_at,
                                                          std::int64_t time,
                                                          const MountPoseAt& T_map_mount) {
  std::vector<triangulation::RawScan> finished;
  for (; nextSample() <= time; ++samples_) {
    if (samples_ > 0) head_.step(1.0 / profile_.sensor.scan.sample_rate);
    if (scan_.currents.empty()) scan_.stamp = nextSample();
    scan_.currents.push_back(
        sample(world_at(nextSample()), T_map_mount(nextSample()), scan_.currents.size()));
    scan_.head_angles.push_back(head_.angle());
    if (scan_.currents.size() == angles_.size()) finished.push_back(std::exchange(scan_, {}));
  }
  return finished;
}

}  // namespace sightline::simulation
