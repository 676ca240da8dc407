#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <ros/ros.h>

#include <sightline/RangeScan.h>
#include "bench/figures.h"
#include "bench/live_node.h"

namespace sightline::bench {

/// The driver with a device that somebody else wrote, from docs/wire_format.md alone: a program in
/// Python, which plays its faults one after the other.
class ForeignDevice {
 public:
  explicit ForeignDevice(const std::string& folder)
      : port_(folder + "/foreign"),
        subscriber_(
            ros::NodeHandle().subscribe("/foreign/range_scan", 100, &ForeignDevice::onScan, this)),
        driver_({SIGHTLINE_PROGRAMS "/sync_scan_driver", "__ns:=foreign", "_port:=" + port_,
                 "_urdf:=" SIGHTLINE_SOURCE_DIR "/urdf/active_sensor.urdf"}) {}

  void run() {
    play();
    ros::Duration(1.0).sleep();
    printFigures();
  }

 private:
  struct Sent {
    std::int64_t stamp = 0;  // [ns]
    std::string phase;
  };
  struct Published {
    std::int64_t stamp = 0;
    bool has_ranges_of_glare = false;
  };

  static constexpr double kCount = 50e-15;                  // [A]
  static constexpr std::int64_t kWrong = 20'000'000;        // [ns] that a stamp may be off
  static constexpr std::int64_t kSettling = 1'000'000'000;  // [ns] after a fault began or ended

  void play() {
    const std::string command =
        "/usr/bin/python3 -u " SIGHTLINE_SOURCE_DIR "/test/bench/driver/foreign_device.py " + port_;
    const std::unique_ptr<FILE, int (*)(FILE*)> output(popen(command.c_str(), "r"), pclose);
    int id = 0;
    long long stamp = 0;
    std::array<char, 64> phase{};
    while (std::fscanf(output.get(), "scan %d %lld %63s\n", &id, &stamp, phase.data()) == 3) {
      sent_[id] = {stamp, phase.data()};
      auto& began = began_.try_emplace(phase.data(), stamp).first->second;
      began = std::min<std::int64_t>(began, stamp);
    }
  }

  void onScan(const RangeScanConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const int id = static_cast<int>(std::lround(message->currents[0] / kCount)) - 120'000;
    Published published{static_cast<std::int64_t>(message->header.stamp.toNSec()), false};
    for (std::size_t i = 0; i < message->ranges.size(); ++i) {
      const bool has_light = std::isfinite(message->currents[i]);
      if (!has_light && !std::isnan(message->ranges[i])) published.has_ranges_of_glare = true;
    }
    published_[id] = published;
  }

  // Whether a scan must come through: a while after a fault began, unless it is of one that makes
  // scans useless.
  bool isDue(const Sent& scan) const {
    return scan.phase.rfind("bad", 0) != 0 && scan.stamp - began_.at(scan.phase) > kSettling;
  }

  void printFigures() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::size_t lost = 0;
    std::size_t wrong = 0;
    std::map<std::string, std::size_t> lost_in;
    double squares = 0.0;
    std::size_t stamps = 0;
    for (const auto& [id, scan] : sent_) {
      if (isDue(scan) && published_.count(id) == 0) ++lost, ++lost_in[scan.phase];
    }
    for (const auto& [id, published] : published_) {
      const auto sent = sent_.find(id);
      const bool is_known = sent != sent_.end() && sent->second.phase.rfind("bad", 0) != 0;
      const std::int64_t error = is_known ? published.stamp - sent->second.stamp : 0;
      const bool is_wrong = !is_known || std::abs(error) > 2.5 * kWrong ||
                            published.has_ranges_of_glare ||
                            (isDue(sent->second) && std::abs(error) > kWrong);
      if (is_wrong) {
        ++wrong;
        std::printf("# driver.foreign: scan %d of %s is wrong, stamp by %.1f ms\n", id,
                    is_known ? sent->second.phase.c_str() : "nothing sent", 1e-6 * error);
      }
      if (!is_known || !isDue(sent->second)) continue;
      squares += std::pow(1e-6 * static_cast<double>(error), 2);
      ++stamps;
    }
    for (const auto& [phase, number] : lost_in) {
      std::printf("# driver.foreign: %zu lost in %s\n", number, phase.c_str());
    }
    std::printf("# driver.foreign: %zu scans sent, %zu published\n", sent_.size(),
                published_.size());
    print("driver.foreign.published_wrong", static_cast<double>(wrong), "scans");
    print("driver.foreign.lost", static_cast<double>(lost), "scans");
    print("driver.foreign.stamp_rms_ms", std::sqrt(squares / static_cast<double>(stamps)), "ms");
  }

  std::string port_;
  std::map<int, Sent> sent_;
  std::map<std::string, std::int64_t> began_;  // [ns]
  std::mutex mutex_;
  std::map<int, Published> published_;
  ros::Subscriber subscriber_;
  Process driver_;
};

}  // namespace sightline::bench
