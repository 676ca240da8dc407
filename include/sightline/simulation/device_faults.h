#pragma once

#include <string>

#include "sightline/simulation/emulated_device.h"

namespace sightline::simulation {

/// Faults of an emulated device by words, one a line or parted by semicolons:
///
///     corrupted SHARE    of the bytes arrive as others
///     dropped SHARE      of the bytes do not arrive
///     bursts SHARE       of the frames have up to 64 bytes of garbage
///     delay SECONDS      of everything
///     jitter SECONDS     on top, uniform, of each frame
///     drift PPM          of the device clock
///     stall SECONDS      neither listens nor speaks
///     reboot SECONDS     likewise, and has forgotten everything
///     disconnect SECONDS the port is gone
class DeviceFaults {
 public:
  explicit DeviceFaults(EmulatedDevice& device) : device_(device) {}

  /// The cable's faults stay until told otherwise. Throws config::Error, naming `source`, with the
  /// word that is not known or has no number of its range; then the words before it hold.
  void apply(const std::string& words, const std::string& source);

 private:
  void applyOne(const std::string& words, const std::string& source);

  EmulatedDevice& device_;
  CableFaults cable_;
};

}  // namespace sightline::simulation
