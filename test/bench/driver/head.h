#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <sightline/HeadCommand.h>
#include "bench/driver/channel.h"
#include "bench/figures.h"
#include "sightline/bridge/time.h"
#include "sightline/geometry/angle.h"
#include "sightline/motion/sensor_head.h"

namespace sightline::bench {

/// True position of a head at each sample since the device began.
class HeadTruth {
 public:
  void add(double angle) {
    const std::lock_guard<std::mutex> lock(mutex_);
    angles_.push_back(angle);
  }
  double at(std::size_t sample) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return angles_.at(sample);
  }

 private:
  mutable std::mutex mutex_;
  std::vector<double> angles_;  // [rad]
};

/// A device with a servo head, and the same light on every sample.
class HeadDevice : public simulation::DeviceModel {
 public:
  static constexpr std::size_t kSamples = 256;
  static constexpr std::int64_t kSample = 400'000;  ///< [ns]

  explicit HeadDevice(std::shared_ptr<HeadTruth> truth) : truth_(std::move(truth)) {}

  std::vector<triangulation::RawScan> advance(std::int64_t time) override {
    std::vector<triangulation::RawScan> scans;
    for (; next_ <= time; next_ += kSample) {
      head_.step(1e-9 * kSample);
      truth_->add(head_.angle());
      if (scan_.currents.empty()) scan_.stamp = next_;
      scan_.currents.push_back({1e-8, 1e-8});
      scan_.head_angles.push_back(head_.angle());
      if (scan_.currents.size() == kSamples) scans.push_back(std::exchange(scan_, {}));
    }
    return scans;
  }
  bool command(const motion::HeadCommand& command) override {
    head_.command(command);
    return true;
  }

 private:
  std::shared_ptr<HeadTruth> truth_;
  motion::SensorHead head_{motion::HeadLimits{}};
  triangulation::RawScan scan_;
  std::int64_t next_ = 0;
};

/// Steps of 90 degrees: how long the head takes by tf, and how well tf knows where it is.
class HeadSteps {
 public:
  explicit HeadSteps(const std::string& folder)
      : channel_("head", folder, std::make_unique<HeadDevice>(truth_)),
        publisher_(ros::NodeHandle().advertise<HeadCommand>("/head/head_command", 10)) {
    channel_.waitForScans();
    while (!tf_.canTransform("active_sensor", "head", ros::Time(0)))
      ros::WallDuration(0.05).sleep();
  }

  void run() {
    const ros::Time begin = ros::Time::now();
    for (const double target : {90.0, 0.0, -90.0, 0.0}) step(geometry::radians(target));
    const ros::Time end = ros::Time::now() - ros::Duration(0.5);
    compare(begin, end);
    const auto delays = channel_.delays(begin, end);
    print("driver.scan_delay_ms", 1e3 * *std::max_element(delays.begin(), delays.end()), "ms");
    print("driver.head.settle_s", settle_, "s");
    print("driver.head.angle_error_deg", geometry::degrees(error_), "deg");
    print("driver.head.unknown_samples", static_cast<double>(unknown_), "samples");
    std::printf("# driver.head: %zu samples compared\n", compared_);
  }

 private:
  double angleAt(const ros::Time& time) const {
    const auto rotation = tf_.lookupTransform("active_sensor", "head", time).transform.rotation;
    return 2.0 * std::atan2(rotation.z, rotation.w);
  }

  void step(double target) {
    HeadCommand command;
    command.mode = HeadCommand::POSITION;
    command.position = target;
    const ros::Time sent = ros::Time::now();
    publisher_.publish(command);
    ros::WallDuration(1.5).sleep();
    double last = 0.0;
    for (double since = 0.0; since < 1.0; since += 0.001) {
      const double off = std::abs(angleAt(sent + ros::Duration(since)) - target);
      if (off > geometry::radians(0.36)) last = since;
    }
    settle_ = std::max(settle_, last + 0.001);
  }

  void compare(const ros::Time& begin, const ros::Time& end) {
    for (const auto& scan : channel_.sent()) {
      for (std::size_t i = 0; i < HeadDevice::kSamples; ++i) {
        const ros::Time time = bridge::timeOf(scan.sent.scan.stamp +
                                              static_cast<std::int64_t>(i) * HeadDevice::kSample);
        if (time < begin || time > end) continue;
        compareSample(time, truth_->at(scan.sent.number * HeadDevice::kSamples + i));
      }
    }
  }

  void compareSample(const ros::Time& time, double truth) {
    try {
      error_ = std::max(error_, std::abs(angleAt(time) - truth));
      ++compared_;
    } catch (const tf2::TransformException&) {
      ++unknown_;
    }
  }

  std::shared_ptr<HeadTruth> truth_ = std::make_shared<HeadTruth>();
  tf2_ros::Buffer tf_{ros::Duration(30.0)};
  tf2_ros::TransformListener listener_{tf_};
  Channel channel_;
  ros::Publisher publisher_;
  double settle_ = 0.0;  // [s]
  double error_ = 0.0;   // [rad]
  std::size_t compared_ = 0;
  std::size_t unknown_ = 0;
};

}  // namespace sightline::bench
