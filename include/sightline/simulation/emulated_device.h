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
                 std::unique_ptr<DeviceModel> model, std::uint64_t seed, OnScan on_scan = {});
  ~EmulatedDevice();
  EmulatedDevice(const EmulatedDevice&) = delete;
  EmulatedDevice& operator=(const EmulatedDevice&) = delete;

  void setCable(const CableFaults& faults);
  void setDrift(double ppm);
  /// The three may overlap: each lasts its time [s]. A frame in whose midst one begins is cut
  /// there.
  ///
  /// Neither listens nor speaks for a while; then goes on with what it was sending.
  void stall(double seconds);
  /// A stall in which everything is forgotten; starts anew once no stall lasts either.
  void reboot(double seconds);
  /// The port is gone; the device goes on.
  void disconnect(double seconds);

  /// Time at which the last stall, reboot or disconnection was over, as of
  /// std::chrono::steady_clock [ns]; 0 while one lasts or before the first one.
  std::int64_t backSince() const { return back_since_; }
  /// Reason why the port is not back although its time has come, which is tried again and again;
  /// empty where all is well.
  std::string trouble() const;

 private:
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
  void leave(Task task);
  void run();
  void runTasks(std::int64_t now);
  void fallSilent(std::int64_t now, std::int64_t until);
  void unplug(std::int64_t now, std::int64_t until);
  void comeBack(std::int64_t now);
  void plugIn(std::int64_t now);
  void work(std::int64_t now);
  void listen(std::int64_t now);
  void hear(std::int64_t now);
  void ship();
  void deliver(std::int64_t now);
  void cut(std::int64_t now);
  void forgetDeliveries();
  bool send(const std::uint8_t* bytes, std::size_t size);
  void report(Delivery& delivery) const;
  void wait(std::int64_t now) const;
  std::int64_t now() const;

  std::string path_;
  int baud_rate_;
  std::unique_ptr<DeviceModel> model_;
  EmulatedFirmware firmware_;
  Cable cable_;
  OnScan on_scan_;
  std::unique_ptr<PseudoTerminal> terminal_;
  std::int64_t steady_origin_;
  std::int64_t system_origin_;
  bool is_away_ = false;    // until it is silent no more and has its port
  bool is_silent_ = false;  // stalled or booting
  bool boots_ = false;      // once it is silent no more
  std::int64_t silent_until_ = 0;
  std::int64_t unplugged_until_ = 0;
  std::deque<Delivery> deliveries_;
  std::deque<Arrival> arrivals_;

  mutable std::mutex mutex_;
  std::vector<Task> tasks_;
  std::string trouble_;
  std::atomic<std::int64_t> back_since_{0};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace sightline::simulation
