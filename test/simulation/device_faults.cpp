#include <gtest/gtest.h>

#include "config_error.h"
#include "sightline/simulation/active_sensor_device.h"
#include "sightline/simulation/device_faults.h"
#include "simulation/port_test.h"
#include "simulation/ramp_device.h"
#include "temporary_folder.h"

namespace sightline::simulation {
namespace {

TEST(Cable, CorruptsTheShareThatItIsTold) {
  Cable cable(1);
  CableFaults faults;
  faults.corrupted = 0.1;
  cable.setFaults(faults);
  const std::vector<std::uint8_t> sent(100000, 7);
  auto received = sent;
  EXPECT_FALSE(cable.pass(received));
  double broken = 0.0;
  for (std::size_t i = 0; i < sent.size(); ++i) broken += sent[i] != received[i] ? 1.0 : 0.0;
  EXPECT_NEAR(broken / static_cast<double>(sent.size()), 0.1, 0.005);
}

TEST(Cable, DropsTheShareThatItIsTold) {
  Cable cable(1);
  CableFaults faults;
  faults.dropped = 0.1;
  cable.setFaults(faults);
  std::vector<std::uint8_t> bytes(100000, 7);
  EXPECT_FALSE(cable.pass(bytes));
  EXPECT_NEAR(static_cast<double>(bytes.size()), 90000.0, 500.0);
}

TEST(Cable, BurstsHitFramesAndSaySo) {
  Cable cable(1);
  CableFaults faults;
  faults.bursts = 0.2;
  cable.setFaults(faults);
  const std::vector<std::uint8_t> sent(2090, 7);
  int hit = 0;
  for (int i = 0; i < 5000; ++i) {
    auto received = sent;
    const bool whole = cable.pass(received);
    ASSERT_EQ(whole, received == sent);
    hit += whole ? 0 : 1;
  }
  EXPECT_NEAR(hit / 5000.0, 0.2, 0.02);
}

TEST(Cable, DelaysEachFrameByItself) {
  Cable cable(1);
  CableFaults faults;
  faults.delay = 0.002;
  faults.jitter = 0.005;
  cable.setFaults(faults);
  double mean = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const auto delay = static_cast<double>(cable.delay());
    ASSERT_GE(delay, 2e6);
    ASSERT_LE(delay, 7e6);
    mean += delay / 10000.0;
  }
  EXPECT_NEAR(mean, 4.5e6, 5e4);
}

class DeviceFaultsTest : public ::testing::Test {
 protected:
  std::string faultOf(const std::string& words) {
    return test::errorOf([&] { faults_.apply(words, "input"); }).what();
  }

  test::TemporaryFolder folder_;
  EmulatedDevice device_{folder_.path("port"), {}, std::make_unique<test::RampDevice>(), 1};
  DeviceFaults faults_{device_};
};

TEST_F(DeviceFaultsTest, WordsThatMakeNoSenseAreNamed) {
  EXPECT_EQ(faultOf("explode 3"), "input: explode: no such fault");
  EXPECT_EQ(faultOf("stall"), "input: stall: needs one number");
  EXPECT_EQ(faultOf("stall long"), "input: stall: needs one number");
  EXPECT_EQ(faultOf("stall 1 2"), "input: stall: needs one number");
  EXPECT_EQ(faultOf("corrupted 2"), "input: corrupted: 2 is outside [0, 1]");
  EXPECT_EQ(faultOf("drift 10; jitter -1"), "input: jitter: -1 is outside [0, 3600]");
}

TEST_F(DeviceFaultsTest, WordsTakeEffect) {
  faults_.apply(" ; jitter 0.001;drift 100 ;; disconnect 0.05", "input");
  EXPECT_TRUE(test::comesTrue([&] { return device_.backSince() > 0; }));
}

TEST(ActiveSensorDevice, MeasuresItsWorldAndTurnsWithinItsLimits) {
  const ActiveSensorProfile profile;
  world::WorldSegment wall;
  wall.segment = {{1.0, -3.0}, {1.0, 3.0}};
  world::World world;
  world.add(wall);
  ActiveSensorDevice device(profile, world, Eigen::Isometry3d::Identity(), 1);
  using HeadMode = motion::HeadCommand::Mode;
  EXPECT_TRUE(device.command({HeadMode::kPosition, 0.3, 0.0}));
  EXPECT_FALSE(device.command({HeadMode::kPosition, 3.0, 0.0}));
  const auto scans = device.advance(1'000'000'000);
  ASSERT_EQ(scans.size(), 9U);
  EXPECT_NEAR(scans.back().head_angles.back(), 0.3, profile.head.resolution);
  EXPECT_GT(scans.back().currents[128].total(), 1e-9);
  const FirmwareConfig firmware = firmwareOf(profile);
  EXPECT_EQ(firmware.identity.serial, profile.sensor.serial);
  EXPECT_EQ(firmware.sample_period, 400'000U);
}

}  // namespace
}  // namespace sightline::simulation
