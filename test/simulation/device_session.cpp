// The session with an emulated device at a pseudo terminal.
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sightline/driver/device_session.h"
#include "sightline/simulation/emulated_device.h"
#include "simulation/ramp_device.h"
#include "temporary_folder.h"

namespace sightline::simulation {
namespace {

using driver::DeviceSession;
using testing::StartsWith;

bool comesTrue(const std::function<bool()>& condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

class PortTest : public ::testing::Test {
 protected:
  driver::SessionConfig config() const {
    driver::SessionConfig config;
    config.port = port_;
    return config;
  }

  void plugIn() {
    device_.emplace(port_, FirmwareConfig{}, std::make_unique<test::RampDevice>(), 1);
  }

  void startSession() {
    session_.emplace(config(), "SS-0001", 256U,
                     [this](const triangulation::RawScan&) { ++scans_; });
  }

  bool moreScansCome() {
    const int before = scans_;
    return comesTrue([&] { return scans_ > before + 2; });
  }

  std::string trouble() const { return session_->status().trouble.text; }

  test::TemporaryFolder folder_;
  const std::string port_ = folder_.path("port");
  std::optional<EmulatedDevice> device_;
  std::optional<DeviceSession> session_;
  std::atomic<int> scans_{0};
};

TEST_F(PortTest, ScansComeThroughATerminal) {
  plugIn();
  startSession();
  EXPECT_TRUE(moreScansCome());
  EXPECT_TRUE(comesTrue([&] { return session_->status().is_scanning; }));
  EXPECT_EQ(session_->status().connections, 1U);
  EXPECT_EQ(session_->status().counts.lost_scans, 0U);
}

TEST_F(PortTest, AbsentPortIsWaitedFor) {
  startSession();
  EXPECT_TRUE(comesTrue([&] { return trouble() != ""; }));
  EXPECT_THAT(trouble(), StartsWith("no such port: " + port_));
  plugIn();
  EXPECT_TRUE(moreScansCome());
  EXPECT_EQ(trouble(), "");
}

TEST_F(PortTest, DisconnectionRebootAndStallAreOvercome) {
  plugIn();
  startSession();
  EXPECT_TRUE(moreScansCome());
  device_->disconnect(0.1);
  EXPECT_TRUE(comesTrue([&] { return session_->status().connections == 2; }));
  EXPECT_TRUE(moreScansCome());
  device_->reboot(0.1);
  EXPECT_TRUE(comesTrue([&] { return session_->status().counts.reboots == 1; }));
  EXPECT_TRUE(moreScansCome());
  device_->stall(0.3);
  EXPECT_TRUE(comesTrue([&] { return session_->status().counts.lost_scans > 0; }));
  EXPECT_TRUE(moreScansCome());
}

TEST_F(PortTest, BrokenBytesAreCounted) {
  plugIn();
  CableFaults faults;
  faults.bursts = 0.3;
  device_->setCable(faults);
  startSession();
  EXPECT_TRUE(comesTrue([&] { return session_->status().line.skipped_bytes > 0; }));
  EXPECT_TRUE(moreScansCome());
}

TEST_F(PortTest, SecondUserIsToldThatThePortIsBusy) {
  plugIn();
  startSession();
  EXPECT_TRUE(moreScansCome());
  DeviceSession second(config(), "SS-0001", 256, [](const triangulation::RawScan&) {});
  EXPECT_TRUE(comesTrue([&] { return second.status().trouble.text != ""; }));
  EXPECT_THAT(second.status().trouble.text, StartsWith("port busy: " + port_));
  session_.reset();
  EXPECT_TRUE(comesTrue([&] { return second.status().is_scanning; })) << "it waits its turn";
}

TEST_F(PortTest, FileIsNoPort) {
  std::ofstream file(port_);
  startSession();
  EXPECT_TRUE(comesTrue([&] { return trouble() != ""; }));
  EXPECT_THAT(trouble(), StartsWith("not a serial port: " + port_));
  EXPECT_THROW(plugIn(), config::Error) << "nor is it replaced by one";
}

TEST_F(PortTest, PermissionIsNeeded) {
  plugIn();
  chmod(port_.c_str(), 0);
  // Root is let in everywhere, so somebody else tries.
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && (chmod(folder_.path("").c_str(), 0755) != 0 || setuid(65534) != 0))
      _exit(2);
    boost::asio::io_context context;
    _exit(driver::SerialLine(context).open(port_, 460800).fault == driver::Fault::kNoPermission
              ? 0
              : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace sightline::simulation
