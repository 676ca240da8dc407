// Stalls, reboots and disconnections of an emulated device: that overlap, and in the midst of a
// frame.
#include <array>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "sightline/driver/frame_parser.h"
#include "sightline/driver/messages.h"
#include "simulation/port_test.h"

namespace sightline::simulation {
namespace {

using test::comesTrue;

struct Absence {
  const char* name;
  void (EmulatedDevice::*begin)(double);
};
constexpr std::array<Absence, 3> kAbsences{Absence{"stall", &EmulatedDevice::stall},
                                           Absence{"reboot", &EmulatedDevice::reboot},
                                           Absence{"disconnect", &EmulatedDevice::disconnect}};

using DeviceAbsences = test::PortTest;

TEST_F(DeviceAbsences, MayOverlap) {
  plugIn();
  startSession();
  std::size_t reboots = 0;
  EXPECT_TRUE(moreScansCome());
  for (const Absence& first : kAbsences) {
    for (const Absence& second : kAbsences) {
      SCOPED_TRACE(std::string(first.name) + " and " + second.name);
      ((*device_).*first.begin)(0.1);
      ((*device_).*second.begin)(0.05);
      EXPECT_TRUE(comesTrue([&] { return device_->backSince() > 0; }));
      const bool boots = first.name == kAbsences[1].name || second.name == kAbsences[1].name;
      reboots += boots ? 1 : 0;
      EXPECT_TRUE(moreScansCome());
      EXPECT_EQ(session_->status().counts.reboots, reboots);
    }
  }
}

TEST_F(DeviceAbsences, PortThatCannotComeBackIsTriedAgain) {
  plugIn();
  startSession();
  EXPECT_TRUE(moreScansCome());
  std::filesystem::rename(folder_.write("file", ""), port_);
  device_->disconnect(0.01);
  EXPECT_TRUE(comesTrue([&] { return !device_->trouble().empty(); }));
  EXPECT_EQ(device_->trouble(), port_ + ": exists, and is no link to a terminal");
  std::filesystem::remove(port_);
  EXPECT_TRUE(comesTrue([&] { return device_->trouble().empty(); }));
  EXPECT_TRUE(moreScansCome());
}

/// The host's end of the line, byte by byte.
class HostEnd {
 public:
  explicit HostEnd(const std::string& port)
      : handle_(::open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)) {}
  ~HostEnd() { close(handle_); }
  HostEnd(const HostEnd&) = delete;
  HostEnd& operator=(const HostEnd&) = delete;

  bool isOpen() const { return handle_ >= 0; }

  template <class Message>
  void send(const Message& message) {
    const auto& frame = encoder_.encode({}, message);
    EXPECT_EQ(write(handle_, frame.data(), frame.size()), static_cast<ssize_t>(frame.size()));
  }

  /// Takes what has come; false once the line has ended.
  bool receive() {
    std::array<std::uint8_t, 1024> buffer{};
    const ssize_t size = read(handle_, buffer.data(), buffer.size());
    if (size <= 0) return size < 0 && errno == EAGAIN;
    came_ += static_cast<std::size_t>(size);
    parser_.append({buffer.data(), static_cast<std::size_t>(size)});
    while (const auto frame = parser_.next()) take(*frame);
    return true;
  }
  bool receivesUntil(const std::function<bool()>& condition) {
    return comesTrue([&] { return receive() && condition(); });
  }

  /// Bytes of a frame whose rest has not come.
  std::size_t pending() const { return came_ - understood_ - parser_.counts().skipped_bytes; }
  std::size_t skipped() const { return parser_.counts().skipped_bytes; }

  std::vector<std::uint32_t> scans;  // their numbers
  std::vector<std::uint32_t> pongs;  // their tokens
  std::size_t identities = 0;

 private:
  void take(const driver::Frame& frame) {
    understood_ += driver::kHeaderSize + frame.payload.size + driver::kTrailerSize;
    driver::ScanReport scan;
    driver::Pong pong;
    driver::Identity identity;
    if (decode(frame, scan)) scans.push_back(scan.number);
    if (decode(frame, pong)) pongs.push_back(pong.token);
    if (decode(frame, identity)) ++identities;
  }

  int handle_;
  driver::FrameEncoder encoder_;
  driver::FrameParser parser_;
  std::size_t came_ = 0;
  std::size_t understood_ = 0;
};

// A port that vanishes during the stall shows that the stall has begun.
TEST_F(DeviceAbsences, WhatIsSaidMeanwhileIsNotObeyed) {
  plugIn();
  for (double seconds = 0.3; seconds < 10.0; seconds *= 2.0) {
    HostEnd before(port_);
    ASSERT_TRUE(before.isOpen());
    device_->stall(seconds);
    device_->disconnect(0.0);
    ASSERT_TRUE(comesTrue([&] { return !before.receive(); }));
    ASSERT_TRUE(comesTrue([&] { return HostEnd(port_).isOpen(); }));
    HostEnd host(port_);
    host.send(driver::Ping{1});
    const bool was_silent = device_->backSince() == 0;
    ASSERT_TRUE(comesTrue([&] { return device_->backSince() > 0; }));
    if (!was_silent) continue;
    host.send(driver::Ping{2});
    EXPECT_TRUE(host.receivesUntil([&] { return !host.pongs.empty(); }));
    EXPECT_EQ(host.pongs, std::vector<std::uint32_t>{2});
    return;
  }
  FAIL() << "the stalls were too short";
}

// On a line so slow that there is always a frame on it.
class CutFrames : public DeviceAbsences {
 protected:
  void SetUp() override {
    FirmwareConfig firmware;
    firmware.baud_rate = 57600;
    plugIn(firmware);
    host_.emplace(port_);
    host_->send(driver::Start{});
    ASSERT_TRUE(host_->receivesUntil([this] { return !host_->scans.empty(); }));
  }
  std::size_t broken() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto isBroken = [](const DeliveredScan& scan) { return !scan.is_whole; };
    return static_cast<std::size_t>(std::count_if(sent_.begin(), sent_.end(), isBroken));
  }

  std::optional<HostEnd> host_;
};

TEST_F(CutFrames, GoOnAfterAStall) {
  device_->stall(0.5);
  EXPECT_TRUE(host_->receivesUntil([this] { return host_->pending() > 0; }));
  const std::size_t before = host_->scans.size();
  EXPECT_TRUE(host_->receivesUntil([&] { return host_->scans.size() > before; }));
  EXPECT_EQ(host_->scans[before], host_->scans[before - 1] + 1);
  EXPECT_EQ(host_->skipped(), 0U);
  EXPECT_EQ(broken(), 0U);
}

TEST_F(CutFrames, AreLostInAReboot) {
  device_->reboot(0.05);
  EXPECT_TRUE(host_->receivesUntil([this] { return host_->pending() > 0; }));
  // A reader takes the ruin's size for true, until enough has come to check its sum.
  EXPECT_TRUE(comesTrue([&] {
    if (device_->backSince() > 0) host_->send(driver::Identify{});
    return host_->receive() && host_->skipped() > 0;
  }));
  EXPECT_GE(host_->identities, 1U);
  EXPECT_GE(broken(), 1U);
  const std::size_t before = host_->scans.size();
  host_->send(driver::Start{});
  EXPECT_TRUE(host_->receivesUntil([&] { return host_->scans.size() > before; }));
}

}  // namespace
}  // namespace sightline::simulation
