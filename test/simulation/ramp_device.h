#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sightline/simulation/device_model.h"

namespace sightline::test {

/// A device without a world: currents that tell which scan and sample they are of, and a head that
/// is at once where it is told to be.
class RampDevice : public simulation::DeviceModel {
 public:
  static constexpr int kSamples = 256;
  static constexpr std::int64_t kSample = 400'000;  ///< [ns]

  std::vector<triangulation::RawScan> advance(std::int64_t time) override {
    std::vector<triangulation::RawScan> scans;
    for (; (number_ + 1) * kSamples * kSample <= time; ++number_) scans.push_back(scan());
    return scans;
  }

  bool command(const motion::HeadCommand& command) override {
    if (!motion::HeadLimits{}.fault(command).empty()) return false;
    angle_ = command.position;
    return true;
  }

  double angle() const { return angle_; }

 private:
  triangulation::RawScan scan() const {
    triangulation::RawScan scan;
    scan.stamp = number_ * kSamples * kSample;
    for (int i = 0; i < kSamples; ++i) {
      scan.currents.push_back({1e-9 * (1.0 + static_cast<double>(number_ % 100)), 1e-10 * i});
      scan.head_angles.push_back(angle_);
    }
    return scan;
  }

  std::int64_t number_ = 0;
  double angle_ = 0.0;
};

}  // namespace sightline::test
