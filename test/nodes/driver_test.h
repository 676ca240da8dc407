#pragma once

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "nodes/comes_true.h"
#include "nodes/diagnostics.h"
#include "sightline/RangeScan.h"
#include "sightline/geometry/isometry.h"
#include "sightline/simulation/active_sensor_device.h"
#include "sightline/simulation/emulated_device.h"
#include "sightline/simulation/scanner.h"
#include "temporary_folder.h"

namespace sightline::test {

/// The node sync_scan_driver in a namespace of its own, ended with the object.
class DriverProcess {
 public:
  /// Parameters as on the command line, such as `_port:=PATH`; `before` goes ahead of the program.
  DriverProcess(const std::string& ns, const std::vector<std::string>& parameters,
                std::vector<std::string> before = {}) {
    std::vector<std::string> words = std::move(before);
    words.push_back(SIGHTLINE_PROGRAMS "/sync_scan_driver");
    words.push_back("__ns:=" + ns);
    words.insert(words.end(), parameters.begin(), parameters.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    process_ = fork();
    if (process_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    execvp(arguments[0], arguments.data());
    std::_Exit(127);
  }
  ~DriverProcess() {
    kill(process_, SIGINT);
    waitpid(process_, nullptr, 0);
  }
  DriverProcess(const DriverProcess&) = delete;
  DriverProcess& operator=(const DriverProcess&) = delete;

 private:
  pid_t process_ = -1;
};

inline std::unique_ptr<simulation::ActiveSensorDevice> deviceInLivingRoom() {
  return std::make_unique<simulation::ActiveSensorDevice>(
      simulation::ActiveSensorProfile{},
      world::World::readFile(SIGHTLINE_SOURCE_DIR "/config/worlds/living_room.yaml"),
      geometry::inSpace({-1.5, 1.0, 2.5}), 1);
}

/// Emulated devices, the drivers that look for them, and what is said of them.
class DriverTest : public ::testing::Test {
 protected:
  /// A device at a port, and its driver in the namespace of the same name.
  void start(const std::string& name, const simulation::FirmwareConfig& firmware = {}) {
    device_.emplace(folder_.path(name), firmware, deviceInLivingRoom(), 1,
                    [this](const simulation::DeliveredScan& scan) { remember(scan); });
    drive(name);
  }
  void drive(const std::string& name) {
    drivers_.push_back(std::make_unique<DriverProcess>(
        name, std::vector<std::string>{"_port:=" + folder_.path(name)}));
  }
  void expectStatus(const std::string& ns, const std::string& text) {
    const std::string name = ns + "/sync_scan_driver: device";
    EXPECT_TRUE(comesTrue([&] { return diagnostics_.text(name).find(text) == 0; }))
        << ns << ": " << diagnostics_.text(name);
  }

  void expectValue(const std::string& ns, const std::string& key, const std::string& value) {
    const std::string name = ns + "/sync_scan_driver: device";
    EXPECT_TRUE(comesTrue([&] { return diagnostics_.value(name, key) == value; }))
        << ns << ": " << key << " " << diagnostics_.value(name, key);
  }

  static bool isOf(const RangeScan& message, const triangulation::RawScan& scan) {
    const auto isSame = [](float current, const triangulation::Photocurrents& pair) {
      return current == static_cast<float>(pair.total());
    };
    return std::equal(message.currents.begin(), message.currents.end(), scan.currents.begin(),
                      scan.currents.end(), isSame);
  }
  void remember(const simulation::DeliveredScan& scan) {
    const std::lock_guard<std::mutex> lock(mutex_);
    sent_.push_back(scan);
  }
  /// The scan that holds the same; noise makes every one different.
  std::optional<simulation::SentScan> sourceOf(const RangeScan& message) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const simulation::DeliveredScan& scan : sent_) {
      if (isOf(message, scan.sent.scan)) return scan.sent;
    }
    return std::nullopt;
  }

  test::TemporaryFolder folder_;
  Diagnostics diagnostics_;
  mutable std::mutex mutex_;
  std::vector<simulation::DeliveredScan> sent_;
  std::optional<simulation::EmulatedDevice> device_;
  std::vector<std::unique_ptr<DriverProcess>> drivers_;
};

}  // namespace sightline::test
