#include "sightline/driver/device_clock.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sightline::driver {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kScan = 256 * 400'000;  // [ns]

// A device on a line, whose clocks do what the test says.
class DeviceClockTest : public ::testing::Test {
 protected:
  std::uint32_t reading(std::int64_t time) const {
    return static_cast<std::uint32_t>((time + ahead_) / 1000);
  }
  std::int64_t onLine(std::size_t bytes) const {
    return is_usb_ ? 0 : static_cast<std::int64_t>(1e9 * lineSeconds(bytes, 460800));
  }

  // A scan and a ping every tenth of a second; the error of the stamp [ms].
  double nextScan() {
    const std::int64_t first = time_;
    const std::int64_t sent = first + 255 * 400'000 + 200'000;
    ScanReport report;
    report.number = number_++;
    report.first_sample = reading(first);
    report.sample_period = 400'000;
    report.currents.resize(256);
    Frame frame;
    frame.payload.size = 2072;
    frame.header.clock = header_sticks_ ? 7 : reading(sent);
    const std::int64_t stamp = clock_.stampOf(frame, report, sent + onLine(2090) + delay_);
    if (pings_) ping(sent + onLine(2090) + kMs);
    time_ += kScan;
    return 1e-6 * static_cast<double>(stamp - first);
  }
  void ping(std::int64_t sent) {
    Frame frame;
    frame.payload.size = 8;
    const Pong pong{0, reading(sent + kMs / 5)};
    frame.header.clock = pong.received + 50;
    clock_.takePong(frame, pong, sent, sent + kMs / 4 + onLine(26) + kMs / 5);
  }
  double worst(int scans) {
    double most = 0.0;
    for (int i = 0; i < scans; ++i) most = std::max(most, std::abs(nextScan()));
    return most;
  }

  DeviceClock clock_{ClockConfig{}, 460800};
  std::int64_t time_ = 5'000 * kMs;
  std::int64_t ahead_ = 0;  // of the device's clock [ns]
  std::int64_t delay_ = 100'000;
  std::uint32_t number_ = 0;
  bool header_sticks_ = false;
  bool is_usb_ = false;
  bool pings_ = true;
};

TEST_F(DeviceClockTest, StampsAreTheFirstSample) {
  EXPECT_LT(worst(100), 0.5);
  EXPECT_FALSE(clock_.isFasterThanSerial());
  EXPECT_EQ(clock_.counts().resets, 0U);
}

TEST_F(DeviceClockTest, NativeUsbIsRecognised) {
  is_usb_ = true;
  worst(10);
  EXPECT_TRUE(clock_.isFasterThanSerial());
  EXPECT_LT(worst(100), 0.5);
  EXPECT_EQ(clock_.counts().resets, 0U);
  is_usb_ = false;
  clock_.open();
  clock_.restart();
  worst(10);
  EXPECT_FALSE(clock_.isFasterThanSerial()) << "another line";
}

TEST_F(DeviceClockTest, ClockThatIsSetIsLearnedAnew) {
  for (const std::int64_t step : {-5000, -50, 50, 5000, 20}) {
    worst(30);
    const std::size_t resets = clock_.counts().resets;
    ahead_ += step * kMs;
    worst(3);
    EXPECT_LT(worst(20), 0.5) << "after " << step << " ms";
    EXPECT_EQ(clock_.counts().resets, resets + 1) << "after " << step << " ms";
  }
}

TEST_F(DeviceClockTest, SamplesTellTheTimeWhereTheHeaderSticks) {
  worst(20);
  header_sticks_ = true;
  EXPECT_LT(worst(200), 0.5);
  EXPECT_EQ(clock_.counts().wrong_headers, 200U);
}

TEST_F(DeviceClockTest, NoStampIsLaterThanItsArrival) {
  pings_ = false;
  worst(20);
  for (int i = 0; i < 20; ++i) {
    ahead_ += 7 * kMs;
    const double error = nextScan();
    EXPECT_LE(error, 1e-6 * static_cast<double>(delay_ + 200'000) + 1e-6);
    EXPECT_GT(error, -7.5);
  }
}

TEST_F(DeviceClockTest, LateBytesDoNotMoveIt) {
  worst(50);
  delay_ = 400 * kMs;
  EXPECT_LT(worst(5), 0.5);
  delay_ = 100'000;
  EXPECT_LT(worst(50), 0.5);
  EXPECT_EQ(clock_.counts().resets, 0U);
}

}  // namespace
}  // namespace sightline::driver
