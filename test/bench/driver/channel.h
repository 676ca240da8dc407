#pragma once

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <ros/ros.h>

#include <sightline/RangeScan.h>
#include "bench/live_node.h"
#include "sightline/bridge/time.h"
#include "sightline/simulation/emulated_device.h"

namespace sightline::bench {

inline std::int64_t steadyNow() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// An emulated device, its driver, and what came of every scan.
class Channel {
 public:
  /// The driver runs in the namespace `name`.
  Channel(const std::string& name, const std::string& folder,
          std::unique_ptr<simulation::DeviceModel> model, double drift = 0.0)
      : device_(folder + "/" + name, firmware(drift), std::move(model), 20261122,
                [this](const simulation::DeliveredScan& scan) { onSent(scan); }),
        subscriber_(ros::NodeHandle().subscribe("/" + name + "/range_scan", 100,
                                                &Channel::onPublished, this,
                                                ros::TransportHints().tcpNoDelay())),
        driver_({SIGHTLINE_PROGRAMS "/sync_scan_driver", "__ns:=" + name,
                 "_port:=" + folder + "/" + name,
                 "_urdf:=" SIGHTLINE_SOURCE_DIR "/urdf/active_sensor.urdf"}) {}

  simulation::EmulatedDevice& device() { return device_; }
  const Process& driver() const { return driver_; }

  std::vector<simulation::DeliveredScan> sent() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return sent_;
  }
  std::size_t published() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return published_.size();
  }
  void waitForScans() const {
    const std::size_t before = published();
    for (int i = 0; i < 2000; ++i) {
      if (published() > before + 2) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    throw std::runtime_error("no scans come");
  }
  /// Arrival of the first scan after such a moment; waits for it [ns].
  std::int64_t arrivalAfter(std::int64_t moment) const {
    for (int i = 0; i < 20000; ++i) {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!published_.empty() && published_.back().arrival > moment) {
          std::size_t first = published_.size() - 1;
          while (first > 0 && published_[first - 1].arrival > moment) --first;
          return published_[first].arrival;
        }
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    throw std::runtime_error("the scans do not come back");
  }

  /// Time from the last sample of each scan to its arrival, of those that began between two moments
  /// of ROS time [s].
  std::vector<double> delays(const ros::Time& begin, const ros::Time& end) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<double> result;
    for (const Publication& publication : published_) {
      const std::int64_t stamp = publication.stamp;
      if (stamp < bridge::nanoseconds(begin) || stamp > bridge::nanoseconds(end)) continue;
      result.push_back(publication.delay);
    }
    return result;
  }

  struct Verdict {
    std::size_t whole = 0;             ///< sent, and arrived whole
    std::size_t broken = 0;            ///< sent, and did not
    std::size_t good_lost = 0;         ///< whole, and not published
    std::size_t bad_published = 0;     ///< published, but never sent so
    std::vector<double> stamp_errors;  ///< of those published, 10 s after the first one [s]
  };
  /// Verdict on the scans sent between the first one published and now, apart from the last second.
  Verdict judge() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    Verdict verdict;
    if (published_.empty()) return judgeUnpublished();
    const std::int64_t first = published_.front().stamp;
    const std::int64_t last = sent_.back().sent.scan.stamp - 1'000'000'000;
    for (const auto& scan : sent_) {
      const std::int64_t stamp = scan.sent.scan.stamp;
      if (stamp < first - kNear || stamp > last) continue;
      ++(scan.is_whole ? verdict.whole : verdict.broken);
      if (scan.is_whole && !publicationOf(scan)) ++verdict.good_lost;
    }
    for (const Publication& publication : published_) {
      const auto* scan = sourceOf(publication);
      if (!scan) ++verdict.bad_published;
      if (!scan || publication.stamp < first + 10'000'000'000) continue;
      verdict.stamp_errors.push_back(
          1e-9 * static_cast<double>(publication.stamp - scan->sent.scan.stamp));
    }
    return verdict;
  }

 private:
  static constexpr std::int64_t kNear = 50'000'000;  // [ns]: half of a scan

  struct Publication {
    std::int64_t arrival = 0;
    std::int64_t stamp = 0;
    double delay = 0.0;  // of the arrival, after the last sample [s]
    std::vector<float> currents;
    std::vector<double> head_angles;
  };

  static simulation::FirmwareConfig firmware(double drift) {
    simulation::FirmwareConfig config;
    config.drift = drift;
    return config;
  }

  void onSent(const simulation::DeliveredScan& scan) {
    const std::lock_guard<std::mutex> lock(mutex_);
    sent_.push_back(scan);
  }
  void onPublished(const RangeScanConstPtr& message) {
    const std::int64_t now = steadyNow();
    const double since_stamp = (ros::Time::now() - message->header.stamp).toSec();
    const auto intervals = static_cast<double>(message->currents.size() - 1);
    const std::lock_guard<std::mutex> lock(mutex_);
    published_.push_back({now, static_cast<std::int64_t>(message->header.stamp.toNSec()),
                          since_stamp - intervals * message->time_increment, message->currents,
                          message->head_angles});
  }

  Verdict judgeUnpublished() const {
    Verdict verdict;
    for (const auto& scan : sent_) ++(scan.is_whole ? verdict.whole : verdict.broken);
    verdict.good_lost = verdict.whole;
    return verdict;
  }

  static bool isSame(const Publication& publication, const simulation::DeliveredScan& sent) {
    const triangulation::RawScan& scan = sent.sent.scan;
    if (std::abs(publication.stamp - scan.stamp) > kNear) return false;
    if (publication.head_angles != scan.head_angles) return false;
    for (std::size_t i = 0; i < scan.currents.size(); ++i) {
      if (publication.currents[i] != static_cast<float>(scan.currents[i].total())) return false;
    }
    return true;
  }
  const simulation::DeliveredScan* sourceOf(const Publication& publication) const {
    for (const auto& scan : sent_) {
      if (isSame(publication, scan)) return &scan;
    }
    return nullptr;
  }
  bool publicationOf(const simulation::DeliveredScan& scan) const {
    for (const Publication& publication : published_) {
      if (isSame(publication, scan)) return true;
    }
    return false;
  }

  mutable std::mutex mutex_;
  std::vector<simulation::DeliveredScan> sent_;
  std::vector<Publication> published_;
  simulation::EmulatedDevice device_;
  ros::Subscriber subscriber_;
  Process driver_;
};

}  // namespace sightline::bench
