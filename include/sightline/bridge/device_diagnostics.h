#pragma once

#include <map>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <diagnostic_updater/update_functions.h>

#include "sightline/bridge/log_throttle.h"
#include "sightline/driver/device_session.h"
#include "sightline/driver/scan_queue.h"

namespace sightline::bridge {

/// Reports the state of a device session: in diagnostics, by the keys of REP-138, and in the log
/// whenever it changes.
class DeviceDiagnostics {
 public:
  /// Registers with the updater. All of them have to live as long.
  DeviceDiagnostics(const driver::SessionConfig& config, const driver::DeviceSession& session,
                    const driver::ScanQueue& queue, double scan_rate,
                    diagnostic_updater::Updater& updater);

  /// A scan was published; from any thread.
  void tick() { frequency_.tick(); }

 private:
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);
  std::vector<std::string> warnings(const driver::SessionStatus& now) const;
  void summarise(const driver::SessionStatus& now,
                 diagnostic_updater::DiagnosticStatusWrapper& status);
  void log(const driver::SessionStatus& now);

  driver::SessionConfig config_;
  const driver::DeviceSession& session_;
  const driver::ScanQueue& queue_;
  double scan_rate_;  // [Hz], for the frequency's own use
  diagnostic_updater::FrequencyStatus frequency_;
  driver::SessionStatus before_;             // at the last report
  std::size_t overruns_before_ = 0;          // likewise
  std::map<std::string, LogThrottle> said_;  // by what stands before the colon
};

}  // namespace sightline::bridge
