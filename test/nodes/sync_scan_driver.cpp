// The driver against emulated devices that behave, and others that do not.
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <tf2_msgs/TFMessage.h>

#include "nodes/driver_test.h"
#include "nodes/quantisation.h"
#include "nodes/recorder.h"
#include "nodes/refusal.h"
#include "sightline/bridge/range_scan_conversion.h"
#include "sightline/lines/line_extractor.h"

namespace sightline {
namespace {

using simulation::EmulatedDevice;
using simulation::FirmwareConfig;
using test::comesTrue;
using test::deviceInLivingRoom;
using test::DriverProcess;
using test::Recorder;
using testing::HasSubstr;

using SyncScanDriver = test::DriverTest;

TEST_F(SyncScanDriver, ScansAndLinesAreWhatTheDeviceMeasured) {
  Recorder<RangeScan> range_scans("/clean/range_scan");
  Recorder<sensor_msgs::LaserScan> scans("/clean/scan");
  Recorder<sensor_msgs::JointState> joints("/clean/joint_states");
  start("clean");
  bridge::RangeScanReader reader;
  std::size_t lines = 0;
  std::size_t others = 0;
  for (const RangeScan& message : range_scans.atLeast(20)) {
    const auto sent = sourceOf(message);
    ASSERT_TRUE(sent);
    EXPECT_EQ(message.header.frame_id, "projection");
    const auto published = reader.read(message);
    test::Quantisation quantisation(sent->measured);
    quantisation.expectSame(published);
    const auto found = lines::LineExtractor().extract(published.scan);
    const auto expected = lines::LineExtractor().extract(quantisation.exact());
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i, ++lines) {
      others += quantisation.areSame(found[i], expected[i]) ? 0 : 1;
    }
  }
  EXPECT_GT(lines, 0U);
  EXPECT_LE(10 * others, lines) << "now and then a beam at a line's end is in or out by a hair";
  EXPECT_FLOAT_EQ(scans.atLeast(1)[0].time_increment, 0.0004F);
  EXPECT_EQ(joints.atLeast(1)[0].name, std::vector<std::string>{"head_joint"});
}

TEST_F(SyncScanDriver, DiagnosticsKnowTheDevice) {
  start("known");
  expectStatus("known", "scanning");
  const std::string name = "known/sync_scan_driver: device";
  EXPECT_EQ(diagnostics_.hardware(name), "SS-0001");
  EXPECT_EQ(diagnostics_.value(name, "Device ID"), "SS-0001");
  EXPECT_EQ(diagnostics_.value(name, "Product Name"), "SYNC-SCAN");
  EXPECT_EQ(diagnostics_.value(name, "Firmware Version"), "1.0");
  EXPECT_EQ(diagnostics_.value(name, "Serial Baud"), "460800");
  EXPECT_EQ(diagnostics_.value(name, "Serial Port"), folder_.path("known"));
  EXPECT_NE(diagnostics_.value(name, "Computed Latency"), "");
}

TEST_F(SyncScanDriver, BrokenBytesShowInDiagnostics) {
  start("broken");
  simulation::CableFaults faults;
  faults.corrupted = 0.01;
  device_->setCable(faults);
  const std::string name = "broken/sync_scan_driver: device";
  EXPECT_TRUE(comesTrue([&] { return diagnostics_.text(name).find("garbage: ") == 0; }))
      << diagnostics_.text(name);
  EXPECT_GT(std::stoi(diagnostics_.value(name, "Broken frames")), 0);
  device_->setCable({});
  expectStatus("broken", "scanning");
}

TEST_F(SyncScanDriver, ScansComeBackWithTheDevice) {
  Recorder<RangeScan> scans("/unsteady/range_scan");
  start("unsteady");
  scans.atLeast(3);
  device_->reboot(0.3);
  expectValue("unsteady", "Reboots of the device", "1");
  scans.atLeast(scans.count() + 3);
  device_->disconnect(0.3);
  expectValue("unsteady", "Connections", "2");
  scans.atLeast(scans.count() + 3);
}

TEST_F(SyncScanDriver, SaysNothingToTfWhereItShallNot) {
  Recorder<tf2_msgs::TFMessage> transforms("/tf");
  Recorder<sensor_msgs::JointState> joints("/mute/joint_states");
  device_.emplace(folder_.path("mute"), FirmwareConfig{}, deviceInLivingRoom(), 1);
  drivers_.push_back(std::make_unique<DriverProcess>(
      "mute", std::vector<std::string>{"_port:=" + folder_.path("mute"), "_publish_tf:=false"}));
  joints.atLeast(10);
  EXPECT_EQ(transforms.count(), 0U);
}

// Whatever is at the port, the driver says so by name and goes on.
TEST_F(SyncScanDriver, FaultsAreNamed) {
  std::vector<std::unique_ptr<EmulatedDevice>> devices;
  const auto plugIn = [&](const std::string& name, const FirmwareConfig& firmware) {
    devices.push_back(
        std::make_unique<EmulatedDevice>(folder_.path(name), firmware, deviceInLivingRoom(), 1));
    drive(name);
  };
  drive("absent");
  folder_.write("file", "");
  drive("file");
  FirmwareConfig firmware;
  firmware.identity.model = "TOASTER";
  plugIn("toaster", firmware);
  firmware = {};
  firmware.version = 7;
  plugIn("newer", firmware);
  firmware = {};
  firmware.identity.serial = "SS-0815";
  plugIn("other", firmware);
  const simulation::PseudoTerminal silent(folder_.path("silent"));
  drive("silent");
  const simulation::PseudoTerminal receiver(folder_.path("receiver"));
  drive("receiver");
  const simulation::PseudoTerminal busy(folder_.path("busy"));
  const int claimed = open(folder_.path("busy").c_str(), O_RDWR | O_NOCTTY);
  flock(claimed, LOCK_EX);
  drive("busy");

  expectStatus("absent", "no such port: " + folder_.path("absent"));
  expectStatus("nodelets", "no such port: /nowhere/port");
  expectStatus("file", "not a serial port: " + folder_.path("file"));
  expectStatus("toaster", "wrong device: 'TOASTER', expected 'SYNC-SCAN'");
  expectStatus("newer", "wrong protocol version: 7, expected 1");
  expectStatus("other",
               "wrong serial number: the device is 'SS-0815', the calibration is for 'SS-0001'");
  expectStatus("silent", "silent device: nothing came for");
  expectStatus("busy", "port busy: " + folder_.path("busy"));
  const std::string sentence = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9\r\n";
  EXPECT_TRUE(comesTrue([&] {
    [[maybe_unused]] const auto size = write(receiver.handle(), sentence.data(), sentence.size());
    return diagnostics_.text("receiver/sync_scan_driver: device").find("garbage: ") == 0;
  }));
  close(claimed);
}

TEST_F(SyncScanDriver, MissingPermissionIsNamed) {
  device_.emplace(folder_.path("locked"), FirmwareConfig{}, deviceInLivingRoom(), 1);
  chmod(folder_.path("locked").c_str(), 0);
  chmod(folder_.path("").c_str(), 0777);
  std::vector<std::string> before;
  if (geteuid() == 0) {  // who is let in everywhere
    before = {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
    const auto reachable = test::runCommand(
        "setpriv --reuid=65534 --regid=65534 --clear-groups "
        "test -x " SIGHTLINE_PROGRAMS "/sync_scan_driver");
    if (reachable.status != 0) GTEST_SKIP() << "nobody else may run the program";
    before.insert(before.end(), {"env", "ROS_LOG_DIR=" + folder_.path("log")});
  }
  const DriverProcess driver("locked", {"_port:=" + folder_.path("locked")}, before);
  expectStatus("locked", "no permission: " + folder_.path("locked"));
}

std::string endOf(const std::string& parameters) {
  return test::refusalOf("sync_scan_driver", parameters);
}

TEST_F(SyncScanDriver, WhatDoesNotFitEndsItAtTheStart) {
  const std::string urdf =
      folder_.write("robot.urdf",
                    "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'>"
                    "<parent link='a'/><child link='b'/></joint></robot>");
  EXPECT_THAT(endOf("_urdf:=" + urdf), HasSubstr(urdf + ": head_joint: no such joint"));
  EXPECT_THAT(endOf("_urdf:=/nowhere.urdf"), HasSubstr("/nowhere.urdf: no such file"));
  EXPECT_THAT(endOf("_joint:=neck"), HasSubstr("/robot_description: neck: no such joint"));
  EXPECT_THAT(endOf("_calibration:=/nowhere.yaml"), HasSubstr("/nowhere.yaml: no such file"));
  EXPECT_THAT(endOf("_baud_rate:=12"), HasSubstr("baud_rate: 12 is outside"));
  const std::string profile =
      folder_.write("profile.yaml", "sensor: SS-0001\norigin: {x: 0.06, y: -0.03}\n");
  EXPECT_THAT(endOf("_profile:=" + profile),
              HasSubstr("projection: is at (0.05, -0.03) m on the head, by the calibration at "
                        "(0.06, -0.03) m"));
}

}  // namespace
}  // namespace sightline
