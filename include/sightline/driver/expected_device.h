#pragma once

#include <cstddef>
#include <string>

#include "sightline/driver/messages.h"
#include "sightline/driver/trouble.h"

namespace sightline::driver {

/// What the calibration says of the device that it is for.
struct ExpectedDevice {
  std::string serial;
  std::size_t samples = 0;     ///< a scan
  double sample_period = 0.0;  ///< [s]; 0: any

  /// Whether a device is another one.
  Trouble faultOf(const Identity& identity) const;
  /// Reason why a scan is not one of this device's; empty where it may be.
  std::string faultOf(const ScanReport& report) const;
};

}  // namespace sightline::driver
