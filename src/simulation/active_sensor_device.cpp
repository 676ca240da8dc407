#include "sightline/simulation/active_sensor_device.h"

#include <cmath>

namespace sightline::simulation {

FirmwareConfig firmwareOf(const ActiveSensorProfile& profile) {
  const triangulation::ScanPattern& scan = profile.sensor.scan;
  FirmwareConfig config;
  config.identity.serial = profile.sensor.serial;
  config.identity.samples = static_cast<std::uint16_t>(scan.beams);
  config.sample_period = static_cast<std::uint32_t>(std::lround(1e9 / scan.sample_rate));
  return config;
}

std::vector<triangulation::RawScan> ActiveSensorDevice::advance(std::int64_t time) {
  return sensor_.advance(world_, time, [this](std::int64_t) { return T_map_mount_; });
}

bool ActiveSensorDevice::command(const motion::HeadCommand& command) {
  if (!sensor_.head().limits().fault(command).empty()) return false;
  sensor_.command(command);
  return true;
}

}  // namespace sightline::simulation
