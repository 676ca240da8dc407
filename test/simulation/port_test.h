#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sightline/driver/device_session.h"
#include "sightline/simulation/emulated_device.h"
#include "simulation/ramp_device.h"
#include "temporary_folder.h"

namespace sightline::test {

/// Whether a condition comes to hold within a minute.
inline bool comesTrue(const std::function<bool()>& condition) {
  for (int i = 0; i < 6000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// An emulated device at a port, and a session that looks for it there.
class PortTest : public ::testing::Test {
 protected:
  driver::SessionConfig config() const {
    driver::SessionConfig config;
    config.port = port_;
    return config;
  }

  void plugIn(const simulation::FirmwareConfig& firmware = {}) {
    device_.emplace(port_, firmware, std::make_unique<RampDevice>(), 1,
                    [this](const simulation::DeliveredScan& scan) {
                      const std::lock_guard<std::mutex> lock(mutex_);
                      sent_.push_back(scan);
                    });
  }

  void startSession() {
    session_.emplace(config(), driver::ExpectedDevice{"SS-0001", 256U}, motion::HeadLimits{},
                     [this](const triangulation::RawScan& scan) {
                       const std::lock_guard<std::mutex> lock(mutex_);
                       received_.push_back(scan.currents[0].first);
                       ++scans_;
                     });
  }

  bool moreScansCome() {
    const int before = scans_;
    return comesTrue([&] { return scans_ > before + 2; });
  }

  std::string trouble() const { return session_->status().trouble.text; }

  /// A child that ends with what `body` returns. Root is let in everywhere, so somebody else goes.
  pid_t asSomebodyElse(const std::function<int()>& body) const {
    if (geteuid() == 0) chmod(folder_.path("").c_str(), 0755);
    const pid_t child = fork();
    if (child == 0) _exit(geteuid() == 0 && setuid(65534) != 0 ? 99 : body());
    return child;
  }
  /// Whether others come to the folder at all: in some roots of containers they do not come past /.
  bool isReachedByOthers() const {
    return waitFor(asSomebodyElse([this] { return access(folder_.path("").c_str(), X_OK); })) == 0;
  }
  /// Its status.
  static int waitFor(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }
  /// The fault that keeps this process out.
  int openPort() const {
    boost::asio::io_context context;
    return static_cast<int>(driver::SerialLine(context).open(port_, 460800).fault);
  }

  TemporaryFolder folder_;
  const std::string port_ = folder_.path("port");
  std::mutex mutex_;
  std::vector<simulation::DeliveredScan> sent_;
  std::vector<double> received_;  // the first current of each scan, which tells them apart
  std::atomic<int> scans_{0};
  std::optional<simulation::EmulatedDevice> device_;
  std::optional<driver::DeviceSession> session_;
};

}  // namespace sightline::test
