#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sightline/simulation/cable.h"
#include "sightline/simulation/emulated_firmware.h"
#include "sightline/simulation/pseudo_terminal.h"

namespace sightline::simulation {

/// A scan frame that went over the cable, or did not.
struct DeliveredScan {
  SentScan sent;
  bool is_whole = false;  ///< every byte came through, and in time
};

/// A synchronised-scan sensor on a pseudo terminal, in real time, with the faults of real cables
/// and devices. It runs in a thread of its own; calls take effect within some milliseconds.
class EmulatedDevice {
 public:
  using OnScan = std::function<void(const DeliveredScan&)>;

  /// The port appears at `path`. The model is asked by the device's thread alone; its times count
  /// from the construction on. Scans are reported by that thread as well, true times as of
  /// std::chrono::system_clock [ns]. Throws config::Error.
  EmulatedDevice(const std::string& path, const FirmwareConfig& config,
                 std::unique_ptr<driver::DeviceModel> model, std::uint64_t seed,
                 OnScan on_scan = {});
  ~EmulatedDevice();
  EmulatedDevice(const EmulatedDevice&) = delete;
  EmulatedDevice& operator=(const EmulatedDevice&) = delete;

  void setCable(const CableFaults& faults);
  void setDrift(double ppm);
  /// Neither listens nor speaks for a while [s].
  void stall(double seconds);
  /// As stall(), and has forgotten everything then.
  void reboot(double seconds);
  /// The port is gone for a while [s]; the device goes on.
  void disconnect(double seconds);

  /// When the last stall, reboot or disconnection was over, as of std::chrono::steady_clock [ns];
  /// 0 while one lasts or before the first one.
  std::int64_t backSince() const { return back_since_; }
  std::size_t bytesSent() const { return bytes_sent_; }

 private:
  enum class Absence { kNone, kStall, kReboot, kDisconnection };
  struct Delivery {
    SentFrame frame;
    std::int64_t due = 0;
    bool is_whole = false;
  };
  struct Arrival {
    std::vector<std::uint8_t> bytes;
    std::int64_t due = 0;
  };
  using Task = std::function<void(std::int64_t)>;

  void post(Task task);
  void leave(Absence absence, double seconds);
  void run();
  void runTasks(std::int64_t now);
  void comeBack(std::int64_t now);
  void work(std::int64_t now);
  void listen(std::int64_t now);
  void hear(std::int64_t now);
  void ship();
  void deliver(std::int64_t now);
  void report(Delivery& delivery, bool is_written) const;
  void wait(std::int64_t now) const;
  std::int64_t now() const;

  std::string path_;
  int baud_rate_;
  std::unique_ptr<driver::DeviceModel> model_;
  EmulatedFirmware firmware_;
  Cable cable_;
  OnScan on_scan_;
  std::unique_ptr<PseudoTerminal> terminal_;
  std::int64_t steady_origin_;
  std::int64_t system_origin_;
  Absence absence_ = Absence::kNone;
  std::int64_t absent_until_ = 0;
  std::deque<Delivery> deliveries_;
  std::deque<Arrival> arrivals_;

  std::mutex mutex_;
  std::vector<Task> tasks_;
  std::atomic<std::int64_t> back_since_{0};
  std::atomic<std::size_t> bytes_sent_{0};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace sightline::simulation
