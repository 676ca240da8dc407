#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sightline/driver/device_session.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::driver {

/// One line of what was found out about a device.
struct CheckResult {
  enum class Verdict { kRight, kWrong, kUndetermined };
  std::string subject;
  std::string found;
  Verdict verdict = Verdict::kRight;
};

/// A scan, and how long after its first sample it was here [s].
struct TimedScan {
  triangulation::RawScan scan;
  double delay = 0.0;
};

/// Judges a device that has been talked to for a while, as a firmware engineer wants to know it.
class DeviceCheck {
 public:
  explicit DeviceCheck(const triangulation::Calibration& calibration) : ranger_(calibration) {}

  /// Identity, numbers, frames and clock, by the session's counts over `seconds`.
  std::vector<CheckResult> ofSession(const SessionStatus& status, double seconds) const;
  /// Time from the first sample to the arrival: steady, and not before the last sample.
  CheckResult ofTiming(const std::vector<TimedScan>& scans) const;
  /// Whether there is light, and not too much.
  CheckResult ofLight(const std::vector<TimedScan>& scans) const;
  /// Order and unit of the currents, by a wall across the line of sight at `depth` [m] of the
  /// projection frame.
  CheckResult ofWall(const std::vector<TimedScan>& scans, double depth) const;
  /// Sense of the head and of the sweep, by what moved in the scan when the head was told to turn
  /// by `turn` [rad], counter-clockwise: scans from before and after.
  std::vector<CheckResult> ofHead(const std::vector<TimedScan>& before,
                                  const std::vector<TimedScan>& after, double turn) const;

 private:
  std::vector<double> medianRanges(const std::vector<TimedScan>& scans, bool exchanged) const;
  double depthAhead(const std::vector<TimedScan>& scans, bool exchanged) const;
  CheckResult ofSweep(const std::vector<TimedScan>& before, const std::vector<TimedScan>& after,
                      double turned) const;

  triangulation::Ranger ranger_;
};

}  // namespace sightline::driver
