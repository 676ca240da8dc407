#include "sightline/logs/carmen_log.h"

#include <gmock/gmock.h>

#include "config_error.h"
#include "sightline/geometry/angle.h"
#include "temporary_folder.h"

namespace sightline::logs {
namespace {

using geometry::degrees;
using test::errorOf;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

std::string flaser(int beams, const std::string& stamp) {
  std::string line = "FLASER " + std::to_string(beams);
  for (int i = 0; i < beams; ++i) line += " 2.50";
  return line + " 9 9 9 1.0 2.0 0.5 " + stamp + " host 0.015885\n";
}

const char* const kRobotLaser =
    "ROBOTLASER1 0 -2.0 4.0 1.0 4.0 0.01 0 3 1.5 9.99 0 3 7 8 9 9 9 9 1.0 2.0 0.5 0.3 -0.1 0 0 0 "
    "225.820438 tinyslam 225.820438\n";

CarmenLaser laserOf(const std::string& line) {
  return std::get<CarmenLaser>(parseCarmenLine(line, "a.clf", 1).value());
}

CarmenLog logOf(const std::string& content) {
  const TemporaryFolder folder;
  return readCarmenLog(folder.write("a.clf", content));
}

TEST(ParseCarmenLine, TakesTheFieldOfViewFromTheNumberOfBeams) {
  struct Mode {
    int beams;
    double first;      // [deg]
    double increment;  // [deg]
  };
  for (const Mode& mode : {Mode{180, -90, 1}, Mode{181, -90, 1}, Mode{360, -90, 0.5},
                           Mode{361, -90, 0.5}, Mode{401, -50, 0.25}, Mode{91, -90, 2}}) {
    const CarmenLaser laser = laserOf(flaser(mode.beams, "1211.520329"));
    EXPECT_NEAR(degrees(laser.angle_min), mode.first, 1e-9);
    EXPECT_NEAR(degrees(laser.angle_increment), mode.increment, 1e-9) << mode.beams;
    EXPECT_EQ(laser.ranges.size(), static_cast<std::size_t>(mode.beams));
  }
}

TEST(ParseCarmenLine, ReadsFrontLasers) {
  const CarmenLaser laser = laserOf(flaser(180, "1211.520329"));
  EXPECT_EQ(laser.stamp, 1211520329000);
  EXPECT_EQ(laser.ranges.front(), 2.5F);
  EXPECT_EQ(laser.robot.coordinates(), Eigen::Vector3d(1.0, 2.0, 0.5));
  EXPECT_FALSE(laser.range_max.has_value());
  EXPECT_FALSE(laser.velocity.has_value());
}

TEST(ParseCarmenLine, ReadsRobotLasers) {
  const CarmenLaser laser = laserOf(kRobotLaser);
  EXPECT_EQ(laser.stamp, 225820438000);
  EXPECT_EQ(laser.angle_min, -2.0);
  EXPECT_EQ(laser.angle_increment, 1.0);
  EXPECT_EQ(laser.range_max, 4.0);
  EXPECT_THAT(laser.ranges, ElementsAre(1.5F, 9.99F, 0.0F));
  EXPECT_THAT(laser.remissions, ElementsAre(7.0F, 8.0F, 9.0F));
  EXPECT_EQ(laser.robot.coordinates(), Eigen::Vector3d(1.0, 2.0, 0.5));
  EXPECT_EQ(laser.velocity->translation, 0.3);
  EXPECT_EQ(laser.velocity->rotation, -0.1);
}

TEST(ParseCarmenLine, ReadsOdometryAndParameters) {
  const auto message =
      parseCarmenLine("ODOM 1 2 0.5 -0.3 0.1 0 1211.642339 magnum 0.12", "a.clf", 1);
  const auto& odometry = std::get<CarmenOdometry>(message.value());
  EXPECT_EQ(odometry.stamp, 1211642339000);
  EXPECT_EQ(odometry.robot.coordinates(), Eigen::Vector3d(1.0, 2.0, 0.5));
  EXPECT_EQ(odometry.velocity.translation, -0.3);
  EXPECT_EQ(odometry.velocity.rotation, 0.1);
  const auto parameter = std::get<CarmenParameter>(
      parseCarmenLine("PARAM robot_front_laser_max 80.99 17 merci 17", "a.clf", 1).value());
  EXPECT_EQ(parameter.name, "robot_front_laser_max");
  EXPECT_EQ(parameter.value, "80.99");
}

TEST(ParseCarmenLine, SaysFileLineAndKindOfWhatIsWrong) {
  const auto reason = [](const std::string& line) {
    return std::string(errorOf([&] { parseCarmenLine(line, "a.clf", 12); }).what());
  };
  EXPECT_EQ(reason("ODOM 1 2 x 0 0 0 17 host 17"),
            "a.clf:12: ODOM: theta: expected a number, found 'x'");
  EXPECT_EQ(reason("ODOM 1 inf 0 0 0 0 17 host 17"),
            "a.clf:12: ODOM: y: expected a finite number, found 'inf'");
  EXPECT_EQ(reason("ODOM 1 2 3 0 0 0 5e9 host 17"),
            "a.clf:12: ODOM: ipc_time: 5000000000.000000000 is no time that a bag can hold");
  EXPECT_EQ(reason("FLASER 1 2.5 0 0 0 0 0 0 17 host 17"),
            "a.clf:12: FLASER: num_readings: 1 beams make no scan");
  EXPECT_EQ(reason("FLASER 4 1 2 3"), "a.clf:12: FLASER: the line ends where a reading should be");
  EXPECT_EQ(reason("FLASER 999999999 1"),
            "a.clf:12: FLASER: num_readings: expected a whole number from 0 to 100000, found "
            "'999999999'");
  EXPECT_EQ(reason("ROBOTLASER1 0 -2.0 4.0 0.0 4.0 0.01 0 0"),
            "a.clf:12: ROBOTLASER1: angular_resolution: has to differ from zero");
  EXPECT_EQ(reason("ROBOTLASER1 0 -2 4 1 4 0.01 0 2 1 1 3 1 1 1"),
            "a.clf:12: ROBOTLASER1: num_remissions: 3 for 2 readings");
}

TEST(ReadCarmenLog, TakesStampsOfZeroAndBelow) {
  const CarmenLog log = logOf(flaser(180, "0.0") + flaser(180, "-17.25"));
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.scans[0].stamp, 0);
  EXPECT_EQ(log.scans[1].stamp, -17250000000);
}

TEST(ReadCarmenLog, KeepsTheOrderOfTheLinesAndCountsWhatItDoesNotRead) {
  const CarmenLog log = logOf("# CARMEN Logfile\nPARAM a 1 17 h 17\n" + flaser(180, "12.5") +
                              "SYNC x 12 h 12\nODOM 2 0 0 0 0 0 11.9 h 0\n" + flaser(180, "12.25") +
                              "ODOM 1 0 0 0 0 0 11.8 h 0\nSYNC x 12 h 12\n\n");
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.scans[0].stamp, 12500000000);
  EXPECT_EQ(log.scans[1].stamp, 12250000000);
  ASSERT_EQ(log.odometry.size(), 2U);
  EXPECT_EQ(log.odometry[0].robot.x(), 2.0);
  EXPECT_THAT(log.parameters, ElementsAre(Pair("a", "1")));
  EXPECT_THAT(log.skipped, ElementsAre(Pair("SYNC", 2U)));
  EXPECT_THAT(log.cut_off, IsEmpty());
}

TEST(ReadCarmenLog, PassesOverLinesItCannotUnderstand) {
  const CarmenLog log = logOf(flaser(180, "12.5") + "ODOM 1 2\nFLASER x\n" + flaser(180, "12.7"));
  EXPECT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.bad_lines, 2U);
  EXPECT_THAT(log.first_fault, HasSubstr("a.clf:2: ODOM: the line ends where theta should be"));
  EXPECT_THAT(log.cut_off, IsEmpty());
}

TEST(ReadCarmenLog, TakesOnlyCapitalsForTheKindOfAMessage) {
  const CarmenLog log = logOf("TRUEPOS 1 2 3\n<html>\n");
  EXPECT_THAT(log.skipped, ElementsAre(Pair("TRUEPOS", 1U)));
  EXPECT_EQ(log.bad_lines, 1U);
  EXPECT_THAT(log.first_fault, HasSubstr("a.clf:2: no message starts with '<html>'"));
}

TEST(ReadCarmenLog, KeepsEverythingBeforeALineThatIsCutOff) {
  const std::string line = flaser(180, "12.7");
  // Within the kind, the readings, the poses and the time.
  for (const std::size_t length : {3UL, 60UL, line.size() - 40, line.size() - 16}) {
    const CarmenLog log =
        logOf(flaser(180, "12.5") + "ODOM 1 2 3 0 0 0 12.6 h 0\n" + line.substr(0, length));
    EXPECT_EQ(log.scans.size(), 1U);
    EXPECT_EQ(log.odometry.size(), 1U);
    EXPECT_THAT(log.cut_off, HasSubstr("a.clf:3: the log is cut off in the middle of a line"))
        << length;
  }
}

TEST(ReadCarmenLog, TakesAWholeLastLineWithoutAnEnd) {
  std::string content = flaser(180, "12.5");
  content.pop_back();
  const CarmenLog log = logOf(content);
  EXPECT_EQ(log.scans.size(), 1U);
  EXPECT_THAT(log.cut_off, IsEmpty());
}

}  // namespace
}  // namespace sightline::logs
