// The session with an emulated device at a pseudo terminal.
#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "simulation/port_test.h"

namespace sightline::simulation {
namespace {

using driver::DeviceSession;
using testing::StartsWith;

using test::comesTrue;
using test::PortTest;

TEST_F(PortTest, ScansComeThroughATerminal) {
  plugIn();
  startSession();
  EXPECT_TRUE(moreScansCome());
  EXPECT_TRUE(comesTrue([&] { return session_->status().is_scanning; }));
  EXPECT_EQ(session_->status().connections, 1U);
}

TEST_F(PortTest, WhatTheDeviceSendsWholeIsHandedOver) {
  plugIn();
  startSession();
  EXPECT_TRUE(comesTrue([&] { return scans_ > 8; }));
  session_.reset();
  device_.reset();
  std::vector<double> whole;
  for (const DeliveredScan& scan : sent_) {
    if (scan.is_whole) whole.push_back(scan.sent.scan.currents[0].first);
  }
  const auto begin = std::find(whole.begin(), whole.end(), received_.front());
  ASSERT_GE(static_cast<std::size_t>(whole.end() - begin), received_.size());
  whole.assign(begin, begin + static_cast<std::ptrdiff_t>(received_.size()));
  EXPECT_EQ(received_, whole);
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
  DeviceSession second(config(), {"SS-0001", 256}, {}, [](const triangulation::RawScan&) {});
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
  if (!isReachedByOthers()) GTEST_SKIP() << "nobody but root reaches the port";
  plugIn();
  chmod(port_.c_str(), 0);
  const int end = waitFor(asSomebodyElse([this] { return openPort(); }));
  EXPECT_TRUE(WIFEXITED(end));
  EXPECT_EQ(WEXITSTATUS(end), static_cast<int>(driver::Fault::kNoPermission));
}

// A program that claimed the port and was killed keeps nobody out.
TEST_F(PortTest, ClaimEndsWithTheProgram) {
  if (!isReachedByOthers()) GTEST_SKIP() << "nobody but root reaches the port";
  plugIn();
  const auto open = [this] {
    chmod(port_.c_str(), 0666);
    return waitFor(asSomebodyElse([this] { return openPort(); }));
  };
  const auto claimAndDie = [this] {
    boost::asio::io_context context;
    driver::SerialLine line(context);
    if (line.open(port_, 460800).fault != driver::Fault::kNone) return 1;
    return raise(SIGKILL);
  };
  chmod(port_.c_str(), 0666);
  const int end = waitFor(asSomebodyElse(claimAndDie));
  ASSERT_TRUE(WIFSIGNALED(end) && WTERMSIG(end) == SIGKILL);
  EXPECT_TRUE(comesTrue([&] { return open() == 0; }));
}

}  // namespace
}  // namespace sightline::simulation
