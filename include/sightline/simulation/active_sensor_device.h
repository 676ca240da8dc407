#pragma once

#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "sightline/simulation/active_sensor.h"
#include "sightline/simulation/device_model.h"
#include "sightline/simulation/emulated_firmware.h"
#include "sightline/world/world.h"

namespace sightline::simulation {

/// Identity of the device of such a sensor.
FirmwareConfig firmwareOf(const ActiveSensorProfile& profile);

/// A simulated sensor that stands still in a world, for an emulated device.
class ActiveSensorDevice : public DeviceModel {
 public:
  /// Throws config::Error.
  ActiveSensorDevice(const ActiveSensorProfile& profile, world::World world,
                     const Eigen::Isometry3d& T_map_mount, std::uint64_t seed)
      : sensor_(profile, seed), world_(std::move(world)), T_map_mount_(T_map_mount) {}

  std::vector<triangulation::RawScan> advance(std::int64_t time) override;
  bool command(const motion::HeadCommand& command) override;

 private:
  ActiveSensor sensor_;
  world::World world_;
  Eigen::Isometry3d T_map_mount_;
};

}  // namespace sightline::simulation
