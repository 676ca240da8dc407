// The clock of a device through messages that are late, against the truth.
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "sightline/driver/clock_estimator.h"

namespace sightline::driver {
namespace {

struct Device {
  double drift = 0.0;       // [ppm]
  std::uint32_t first = 0;  // its clock at time 0
  double constant = 0.002;  // delay of every message, either way [s]
  double jitter = 0.005;    // uniform, on top [s]

  std::uint32_t clockAt(double time) const {
    return first + static_cast<std::uint32_t>(
                       static_cast<std::uint64_t>(std::llround(1e6 * time * (1.0 + 1e-6 * drift))));
  }
};

std::int64_t nanoseconds(double seconds) {
  return std::llround(1e9 * seconds);
}

// Scans at 9.77 Hz and pings at 4 Hz, from `begin` to `end`.
class Contact {
 public:
  Contact(const Device& device, ClockEstimator& estimator)
      : device_(device), estimator_(estimator) {}

  void go(double begin, double end) {
    double ping = begin;
    for (double time = begin; time < end; time += 0.1024) {
      estimator_.observeArrival(device_.clockAt(time), nanoseconds(time + delay()));
      error(time);
      if (time < ping) continue;
      ping += 0.25;
      estimator_.observeDeparture(nanoseconds(time), device_.clockAt(time + delay()));
    }
  }

  double rmsAfter(double time) const {
    double sum = 0.0;
    double count = 0.0;
    for (const auto& [at, error] : errors_) {
      if (at < time) continue;
      sum += error * error;
      ++count;
    }
    return std::sqrt(sum / count);
  }

 private:
  double delay() {
    return device_.constant + std::uniform_real_distribution<>(0.0, device_.jitter)(random_);
  }
  // Error of the time of a scan that began a tenth of a second before it was sent.
  void error(double time) {
    const auto estimate = estimator_.hostTime(device_.clockAt(time - 0.1));
    ASSERT_TRUE(estimate);
    errors_.emplace_back(time, 1e-9 * static_cast<double>(*estimate) - (time - 0.1));
  }

  Device device_;
  ClockEstimator& estimator_;
  std::mt19937_64 random_{20261122};
  std::vector<std::pair<double, double>> errors_;
};

double rmsOf(const Device& device, const ClockConfig& config = {}) {
  ClockEstimator estimator(config);
  Contact contact(device, estimator);
  contact.go(1.0, 120.0);
  EXPECT_EQ(estimator.resets(), 0U);
  return contact.rmsAfter(11.0);
}

TEST(ClockEstimator, KnowsNothingBeforeTheFirstMessage) {
  ClockEstimator estimator;
  estimator.observeDeparture(5, 5);
  EXPECT_FALSE(estimator.hostTime(0));
  estimator.observeArrival(1000, 5'000'000);
  EXPECT_EQ(estimator.hostTime(2000), 6'000'000);
}

TEST(ClockEstimator, FollowsDriftThroughJitter) {
  for (const double drift : {-100.0, 0.0, 100.0}) {
    Device device;
    device.drift = drift;
    EXPECT_LT(rmsOf(device), 1e-4) << drift;
  }
}

TEST(ClockEstimator, LatencyIsMeasuredOrGiven) {
  Device device;
  device.constant = 0.010;
  EXPECT_LT(rmsOf(device), 1e-4);
  ClockConfig given;
  given.latency = 0.010;
  EXPECT_LT(rmsOf(device, given), 1e-4);
  given.latency = 0.0;
  EXPECT_NEAR(rmsOf(device, given), 0.010, 1e-4) << "the user says so";
}

TEST(ClockEstimator, WrapGoesUnnoticed) {
  Device device;
  device.drift = 100.0;
  device.first = 0xFFFFFFFFU - 30'000'000U;  // 30 s before
  EXPECT_LT(rmsOf(device), 1e-4);
}

TEST(ClockEstimator, SurvivesLongSilence) {
  Device device;
  device.drift = 20.0;
  ClockEstimator estimator;
  Contact contact(device, estimator);
  contact.go(1.0, 60.0);
  contact.go(6000.0, 6060.0);  // more than a wrap later
  EXPECT_EQ(estimator.resets(), 0U);
  EXPECT_LT(contact.rmsAfter(6010.0), 2e-4);
}

TEST(ClockEstimator, RestartedDeviceStartsANewEstimate) {
  ClockEstimator estimator;
  Device device;
  device.first = 77'000'000;
  Contact(device, estimator).go(1.0, 60.0);
  device.first = 0U - 60'000'000U;  // 0 at 60 s
  Contact again(device, estimator);
  again.go(61.0, 120.0);
  EXPECT_EQ(estimator.resets(), 1U) << "by itself";
  EXPECT_LT(again.rmsAfter(71.0), 1e-4);
  estimator.reset();
  EXPECT_FALSE(estimator.hostTime(0)) << "told so";
}

TEST(ClockEstimator, LateMessagesDoNotMatter) {
  ClockEstimator estimator;
  Contact contact({}, estimator);
  contact.go(1.0, 30.0);
  const Device device;
  for (int i = 0; i < 20; ++i) {
    const double time = 30.0 + 0.001 * i;
    estimator.observeArrival(device.clockAt(time), nanoseconds(time + 0.5));
  }
  EXPECT_NEAR(1e-9 * static_cast<double>(*estimator.hostTime(device.clockAt(30.0))), 30.0, 2e-4);
}

// A host that was held up gets everything at once.
TEST(ClockEstimator, HeldUpHostKeepsTheClock) {
  ClockEstimator estimator;
  Contact contact({}, estimator);
  contact.go(1.0, 30.0);
  const Device device;
  for (int i = 0; i < 30; ++i) {
    estimator.observeArrival(device.clockAt(30.0 + 0.1 * i), nanoseconds(33.0 + 1e-4 * i));
  }
  EXPECT_EQ(estimator.resets(), 0U);
  EXPECT_NEAR(1e-9 * static_cast<double>(*estimator.hostTime(device.clockAt(33.0))), 33.0, 2e-4);
}

TEST(ClockEstimator, DriftIsLimited) {
  ClockConfig config;
  config.max_drift = 50.0;
  ClockEstimator estimator(config);
  Device device;
  device.drift = 5000.0;
  Contact(device, estimator).go(1.0, 20.0);
  EXPECT_NEAR(estimator.drift(), -50e-6, 1e-9);
}

}  // namespace
}  // namespace sightline::driver
