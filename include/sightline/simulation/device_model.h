#pragma once

#include <cstdint>
#include <vector>

#include "sightline/motion/head_command.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::simulation {

/// Measurements of a device and the rotation of its head: to be given to an emulated device.
class DeviceModel {
 public:
  virtual ~DeviceModel() = default;

  /// Goes on to `time` [ns], which never goes back, and returns the scans that ended since the last
  /// call, stamped with the time of their first sample.
  virtual std::vector<triangulation::RawScan> advance(std::int64_t time) = 0;
  /// False where the command is beyond the limits of the head and nothing is done.
  virtual bool command(const motion::HeadCommand& command) = 0;
};

}  // namespace sightline::simulation
