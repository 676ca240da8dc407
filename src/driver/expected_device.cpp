#include "sightline/driver/expected_device.h"

#include <cmath>

#include <fmt/format.h>

namespace sightline::driver {

namespace {

constexpr double kSamePeriod = 0.01;  // share by which a sample period may differ

}  // namespace

Trouble ExpectedDevice::faultOf(const Identity& identity) const {
  if (identity.model != kModel) {
    return trouble(Fault::kWrongDevice, fmt::format("'{}', expected '{}'", identity.model, kModel));
  }
  if (identity.serial != serial) {
    return trouble(
        Fault::kWrongSerial,
        fmt::format("the device is '{}', the calibration is for '{}'", identity.serial, serial));
  }
  if (identity.samples != samples) {
    return trouble(Fault::kWrongSamples, fmt::format("the device takes {}, the calibration has {}",
                                                     identity.samples, samples));
  }
  return {};
}

std::string ExpectedDevice::faultOf(const ScanReport& report) const {
  if (report.currents.size() != samples) {
    return fmt::format("{} samples, {} expected", report.currents.size(), samples);
  }
  const double period = 1e-9 * report.sample_period;
  if (sample_period <= 0.0 || std::abs(period / sample_period - 1.0) <= kSamePeriod) return {};
  return fmt::format("a sample every {:.1f} us, the calibration is for {:.1f} us", 1e6 * period,
                     1e6 * sample_period);
}

}  // namespace sightline::driver
