// The two ends of the wire format against each other, in a time of their own.
#include <cmath>
#include <deque>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/sample_messages.h"
#include "sightline/driver/conversation.h"
#include "sightline/simulation/emulated_firmware.h"
#include "simulation/ramp_device.h"

namespace sightline::simulation {
namespace {

using driver::Conversation;
using driver::ConversationConfig;
using driver::Fault;
using driver::Moment;
using testing::HasSubstr;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSystemAhead = 1'700'000'000'000'000'000;

class TwoEnds : public ::testing::Test {
 protected:
  explicit TwoEnds(const FirmwareConfig& firmware = {}, const ConversationConfig& host = config())
      : firmware_(std::in_place, firmware, device_, 1),
        host_(host, [this](const triangulation::RawScan& scan) { scans_.push_back(scan); }) {}

  static ConversationConfig config() {
    ConversationConfig config;
    config.device.serial = "SS-0001";
    config.device.samples = 256;
    config.clock.latency = 0.0;
    return config;
  }

  Moment moment() const { return {time_, time_ + kSystemAhead}; }

  void connect() {
    firmware_->boot(time_);
    host_.open(moment());
  }

  // Runs in steps of a millisecond. Frames come when their last byte has gone.
  void run(std::int64_t duration) {
    for (const std::int64_t end = time_ + duration; time_ < end; time_ += kMs) {
      if (awake_) firmware_->advance(time_);
      if (!awake_) firmware_->sleep(time_);
      for (SentFrame& frame : firmware_->take()) line_.push_back(std::move(frame));
      for (; !line_.empty() && line_.front().sent <= time_; line_.pop_front()) {
        const auto& bytes = line_.front().bytes;
        if (awake_) host_.receive({bytes.data(), bytes.size()}, moment());
      }
      const auto& bytes = host_.send(moment());
      if (awake_) firmware_->receive({bytes.data(), bytes.size()}, time_);
    }
  }

  test::RampDevice device_;
  std::optional<EmulatedFirmware> firmware_;
  Conversation host_;
  std::vector<triangulation::RawScan> scans_;
  std::deque<SentFrame> line_;
  std::int64_t time_ = 500 * kMs;
  bool awake_ = true;
};

TEST_F(TwoEnds, ScansComeWithTheirTimes) {
  connect();
  run(3000 * kMs);
  ASSERT_GE(scans_.size(), 27U);
  EXPECT_TRUE(host_.isScanning(moment()));
  EXPECT_EQ(host_.currentTrouble().fault, Fault::kNone);
  for (const auto& scan : scans_) {
    const double number = std::round(scan.currents[0].first / 1e-9) - 1.0;
    const double stamp = kSystemAhead + number * 256 * 400'000;
    // The steps of this test are a millisecond, and the first frames know no better.
    EXPECT_NEAR(static_cast<double>(scan.stamp), stamp, 2.0 * kMs);
    EXPECT_NEAR(scan.currents[7].second, 7e-10, 0.5e-16);
  }
  EXPECT_EQ(host_.counts().lost_scans, 0U);
  EXPECT_EQ(host_.counts().refused_scans, 0U);
  ASSERT_TRUE(host_.device());
  EXPECT_EQ(host_.device()->serial, "SS-0001");
}

TEST_F(TwoEnds, RebootedDeviceIsStartedAgain) {
  connect();
  run(1000 * kMs);
  const std::size_t before = scans_.size();
  awake_ = false;
  run(700 * kMs);
  EXPECT_FALSE(host_.isScanning(moment()));
  awake_ = true;
  firmware_->boot(time_);
  run(300 * kMs);
  EXPECT_GT(scans_.size(), before);
  EXPECT_EQ(host_.counts().reboots, 1U);
  EXPECT_EQ(host_.counts().lost_scans, 0U) << "it counts anew";
}

TEST_F(TwoEnds, RebootWithoutAWordIsNoticed) {
  connect();
  run(1000 * kMs);
  firmware_->boot(time_);
  firmware_->take();  // its first words are lost
  const std::size_t before = scans_.size();
  run(800 * kMs);
  EXPECT_GT(scans_.size(), before + 2);
  EXPECT_EQ(host_.counts().reboots, 1U);
}

TEST_F(TwoEnds, SilenceIsAFaultAndEnds) {
  connect();
  run(1000 * kMs);
  awake_ = false;
  run(1500 * kMs);
  EXPECT_EQ(host_.currentTrouble().fault, Fault::kSilentDevice);
  EXPECT_THAT(host_.currentTrouble().text, HasSubstr("silent device: nothing came for"));
  awake_ = true;
  const std::size_t before = scans_.size();
  run(300 * kMs);
  EXPECT_GT(scans_.size(), before);
  EXPECT_EQ(host_.currentTrouble().fault, Fault::kNone);
  EXPECT_GT(host_.counts().lost_scans, 10U);
}

TEST_F(TwoEnds, RebootInTheMidstOfAFrameIsOvercome) {
  connect();
  run(1000 * kMs);
  while (line_.empty() || line_.front().bytes.size() < 1000) run(kMs);
  const auto cut = line_.front().bytes;
  line_.clear();
  host_.receive({cut.data(), cut.size() / 2}, moment());
  const std::size_t before = scans_.size();
  firmware_->boot(time_);
  run(300 * kMs);
  EXPECT_GT(scans_.size(), before);
}

TEST_F(TwoEnds, GarbageIsAFault) {
  host_.open(moment());
  const std::vector<std::uint8_t> line{'$', 'G', 'P', 'G', 'G', 'A', ',', 'S', 'L', '\n'};
  for (int i = 0; i < 20; ++i) {
    time_ += 100 * kMs;
    host_.receive({line.data(), line.size()}, moment());
    host_.send(moment());
  }
  EXPECT_THAT(host_.currentTrouble().text, HasSubstr("garbage: bytes, and no scan for 2 s"));
}

TEST_F(TwoEnds, HeadCommandsAreObeyedOrRefused) {
  connect();
  run(500 * kMs);
  using HeadMode = motion::HeadCommand::Mode;
  host_.command({HeadMode::kPosition, 0.7, 0.0}, moment());
  run(50 * kMs);
  EXPECT_NEAR(device_.angle(), 0.7, 1e-9);
  EXPECT_EQ(host_.commandCounts().refused, 0U);
  host_.command({HeadMode::kPosition, 3.0, 0.0}, moment());
  run(50 * kMs);
  EXPECT_NEAR(device_.angle(), 0.7, 1e-9);
  EXPECT_EQ(host_.commandCounts().refused, 1U);
}

TEST_F(TwoEnds, HeadCommandsGrowOld) {
  connect();
  run(500 * kMs);
  awake_ = false;
  using HeadMode = motion::HeadCommand::Mode;
  host_.command({HeadMode::kPosition, 0.7, 0.0}, moment());
  run(1200 * kMs);
  awake_ = true;
  run(1000 * kMs);
  EXPECT_EQ(device_.angle(), 0.0) << "a second later nobody expects it to move";
  EXPECT_EQ(host_.commandCounts().lost, 1U);
}

// A device that names one number of samples and sends another.
TEST_F(TwoEnds, RefusedScansAreNamed) {
  connect();
  run(500 * kMs);
  const std::size_t scans = scans_.size();
  driver::FrameEncoder encoder;
  for (std::uint32_t i = 0; i < 20; ++i) {
    driver::ScanReport report = test::scanReport(100 + i);
    report.boot = host_.device()->boot;
    report.currents.resize(200);
    report.head_angles.resize(200);
    firmware_->take();
    time_ += 100 * kMs;
    const auto& bytes = encoder.encode({}, report);
    host_.receive({bytes.data(), bytes.size()}, moment());
    host_.send(moment());
  }
  EXPECT_EQ(scans_.size(), scans);
  EXPECT_EQ(host_.currentTrouble().text, "scans refused: 200 samples, 256 expected");
  EXPECT_EQ(host_.counts().refused_scans, 20U);
}

TEST_F(TwoEnds, CountsAtTheirEndAreNoCurrents) {
  connect();
  run(500 * kMs);
  driver::ScanReport report = test::scanReport(100);
  report.boot = host_.device()->boot;
  report.currents[3].first = driver::kMaxCount;
  report.currents[5].second = -driver::kMaxCount - 1;
  driver::FrameEncoder encoder;
  const auto& bytes = encoder.encode({}, report);
  host_.receive({bytes.data(), bytes.size()}, moment());
  ASSERT_FALSE(scans_.empty());
  EXPECT_TRUE(std::isnan(scans_.back().currents[3].total()));
  EXPECT_TRUE(std::isnan(scans_.back().currents[5].total()));
  EXPECT_TRUE(std::isfinite(scans_.back().currents[4].total()));
  EXPECT_EQ(host_.counts().saturated_scans, 0U) << "two may be a glint";
}

TEST_F(TwoEnds, SlowDeviceIsLeftInPeace) {
  connect();
  run(500 * kMs);
  awake_ = false;
  std::size_t questions = 0;
  for (int i = 0; i < 500; ++i, time_ += 20 * kMs) {
    questions += host_.send(moment()).empty() ? 0U : 1U;
  }
  EXPECT_LT(questions, 65U) << "in ten seconds, with pings";
}

TEST_F(TwoEnds, StopEndsTheScans) {
  connect();
  run(500 * kMs);
  const auto& bytes = host_.stop(moment());
  firmware_->receive({bytes.data(), bytes.size()}, time_);
  firmware_->take();
  firmware_->advance(time_ + 1000 * kMs);
  EXPECT_TRUE(firmware_->take().empty());
}

TEST_F(TwoEnds, WrapOfTheDeviceClockGoesUnnoticed) {
  FirmwareConfig late;
  late.first_clock = 0xFFFFFFFFU - 1'000'000U;
  firmware_.emplace(late, device_, 1);
  connect();
  run(3000 * kMs);
  EXPECT_EQ(host_.counts().reboots, 0U);
  EXPECT_EQ(host_.clock().counts().resets, 0U);
  for (std::size_t i = 1; i < scans_.size(); ++i) {
    EXPECT_NEAR(1e-9 * static_cast<double>(scans_[i].stamp - scans_[i - 1].stamp), 0.1024, 0.002);
  }
}

// Reasons for which a device with this firmware is refused.
class Strangers : public TwoEnds {
 protected:
  std::string troubleWith(const FirmwareConfig& config) {
    firmware_.emplace(config, device_, 1);
    connect();
    run(1500 * kMs);
    EXPECT_TRUE(scans_.empty());
    return host_.currentTrouble().text;
  }
};

TEST_F(Strangers, AreRefusedByName) {
  FirmwareConfig config;
  config.identity.model = "TOASTER";
  EXPECT_EQ(troubleWith(config), "wrong device: 'TOASTER', expected 'SYNC-SCAN'");
}

TEST_F(Strangers, NeedTheirOwnCalibration) {
  FirmwareConfig config;
  config.identity.serial = "SS-0002";
  EXPECT_EQ(troubleWith(config),
            "wrong serial number: the device is 'SS-0002', the calibration is for 'SS-0001'");
}

TEST_F(Strangers, HaveAsManySamplesAsTheCalibration) {
  FirmwareConfig config;
  config.identity.samples = 128;
  EXPECT_EQ(troubleWith(config),
            "wrong number of samples: the device takes 128, the calibration "
            "has 256");
}

TEST_F(Strangers, SpeakThisVersion) {
  FirmwareConfig config;
  config.version = 2;
  EXPECT_EQ(troubleWith(config), "wrong protocol version: 2, expected 1");
}

}  // namespace
}  // namespace sightline::simulation
