#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sightline/bridge/scan_conversion.h"

namespace sightline::bridge {
namespace {

using scan::ReturnKind;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

sensor_msgs::LaserScan message() {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time(12, 345);
  scan.header.frame_id = "laser";
  scan.angle_min = -1.0F;
  scan.angle_max = 1.0F;
  scan.angle_increment = 0.5F;
  scan.time_increment = 0.001F;
  scan.range_min = 0.1F;
  scan.range_max = 10.0F;
  scan.ranges = {1.0F, 2.0F, 3.0F, 4.0F, 5.0F};
  return scan;
}

std::string faultOf(const sensor_msgs::LaserScan& scan) {
  ScanReader reader;
  try {
    reader.read(scan);
  } catch (const scan::InvalidScan& fault) {
    return fault.what();
  }
  return "none";
}

TEST(ScanReader, TakesOverWhatTheMessageSays) {
  auto scan_message = message();
  scan_message.intensities = {5.0F, 6.0F, 7.0F, 8.0F, 9.0F};
  const scan::Scan scan = ScanReader().read(scan_message);
  EXPECT_EQ(scan.stamp, 12'000'000'345);
  EXPECT_EQ(scan.frame, "laser");
  EXPECT_THAT(scan.ranges(), testing::ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0));
  EXPECT_THAT(scan.intensities(), testing::ElementsAre(5.0, 6.0, 7.0, 8.0, 9.0));
  EXPECT_THAT(scan.kinds(), testing::Each(ReturnKind::kValid));
  EXPECT_DOUBLE_EQ(scan.geometry()->angles()[2], 0.0);
  EXPECT_NEAR(scan.geometry()->timeOffsets()[4], 0.004, 1e-9);
  EXPECT_TRUE(scan.sensorMotion().empty());
}

TEST(ScanReader, SortsReturnsByRep117) {
  auto scan_message = message();
  scan_message.ranges = {kNan, kInfinity, -kInfinity, 0.0F, -1.0F};
  EXPECT_THAT(ScanReader().read(scan_message).kinds(),
              testing::ElementsAre(ReturnKind::kInvalid, ReturnKind::kNothing, ReturnKind::kTooNear,
                                   ReturnKind::kInvalid, ReturnKind::kInvalid));
  scan_message.ranges = {0.05F, 0.1F, 10.0F, 10.1F, 5.0F};
  EXPECT_THAT(ScanReader().read(scan_message).kinds(),
              testing::ElementsAre(ReturnKind::kTooNear, ReturnKind::kValid, ReturnKind::kValid,
                                   ReturnKind::kNothing, ReturnKind::kValid));
}

TEST(ScanReader, NamesTheFaultOfAScanThatCannotBeUsed) {
  auto scan = message();
  scan.ranges.clear();
  EXPECT_EQ(faultOf(scan), "no beams");
  scan = message();
  scan.angle_max = scan.angle_min;
  scan.angle_increment = 0.0F;
  EXPECT_EQ(faultOf(scan), "an angle increment of 0");
  scan.angle_increment = kNan;
  EXPECT_EQ(faultOf(scan), "an angle increment of nan");
  scan = message();
  scan.angle_min = kNan;
  EXPECT_EQ(faultOf(scan), "an angle that is not finite");
  scan = message();
  scan.angle_max = 400.0F;
  scan.angle_increment = 2.0F;
  EXPECT_THAT(faultOf(scan), testing::HasSubstr("more than a turn"));
}

TEST(ScanReader, DoesWithoutFieldsThatCannotBeTrue) {
  const auto mendedIn = [](const sensor_msgs::LaserScan& scan) {
    ScanReader reader;
    EXPECT_EQ(reader.read(scan).beams(), 5U);
    std::string text;
    for (const auto& [field, fault] : reader.mended()) text += fault;
    return text;
  };
  EXPECT_EQ(mendedIn(message()), "");
  auto scan = message();
  scan.intensities = {1.0F, 2.0F};
  EXPECT_EQ(mendedIn(scan), "2 intensities for 5 ranges: taken for none");
  scan = message();
  scan.range_min = 20.0F;
  EXPECT_THAT(mendedIn(scan), testing::HasSubstr("range limits 20 to"));
  scan = message();
  scan.range_max = kNan;
  EXPECT_THAT(mendedIn(scan), testing::HasSubstr("range limits"));
  for (const float increment : {153333.0F, kNan}) {
    scan = message();
    scan.time_increment = increment;
    EXPECT_THAT(mendedIn(scan), testing::HasSubstr("of unknown duration"));
    EXPECT_EQ(ScanReader().read(scan).duration(), 0.0);
  }
  scan = message();
  scan.angle_max = scan.angle_min + 4.0F * scan.angle_increment;
  const double increment = scan.angle_increment;
  for (const float wrong : {0.0F, kNan, 57.3F}) {
    scan.angle_increment = wrong;
    EXPECT_THAT(mendedIn(scan), testing::HasSubstr("by angle_min and angle_max"));
    EXPECT_NEAR(ScanReader().read(scan).geometry()->angleIncrement(), increment, 1e-6);
  }
}

// The past is nothing to a reader: what a scan of another time means is for its user to say.
TEST(ScanReader, TakesScansInAnyOrderOfTime) {
  ScanReader reader;
  auto scan = message();
  EXPECT_EQ(reader.read(scan).stamp, 12'000'000'345);
  scan.header.stamp = ros::Time(1, 0);
  EXPECT_EQ(reader.read(scan).stamp, 1'000'000'000);
}

TEST(ScanReader, AGoodScanAfterABadOneIsRead) {
  ScanReader reader;
  auto bad = message();
  bad.ranges.clear();
  EXPECT_THROW(reader.read(bad), scan::InvalidScan);
  EXPECT_EQ(reader.read(message()).beams(), 5U);
}

TEST(ScanReader, KeepsTheGeometryOfOneSensorAndMakesANewOneForAnother) {
  ScanReader reader;
  const auto first = reader.read(message()).geometry();
  EXPECT_EQ(reader.read(message()).geometry(), first);
  auto longer = message();
  longer.ranges.push_back(6.0F);
  const auto second = reader.read(longer).geometry();
  EXPECT_NE(second, first);
  EXPECT_EQ(second->beams(), 6U);
  EXPECT_EQ(reader.read(message()).geometry()->beams(), 5U);
}

TEST(ScanReader, NegativeIncrementsTurnClockwise) {
  auto scan_message = message();
  scan_message.angle_min = 1.0F;
  scan_message.angle_increment = -0.5F;
  const scan::Scan scan = ScanReader().read(scan_message);
  EXPECT_DOUBLE_EQ(scan.geometry()->angles()[0], 1.0);
  EXPECT_DOUBLE_EQ(scan.geometry()->angles()[4], -1.0);
}

TEST(ScanConversion, GoesThereAndBack) {
  auto scan_message = message();
  scan_message.ranges = {1.0F, kInfinity, -kInfinity, kNan, 5.0F};
  scan_message.intensities = {1.0F, 2.0F, 3.0F, 4.0F, 5.0F};
  const auto back = toMessage(ScanReader().read(scan_message));
  EXPECT_EQ(back.header.stamp, scan_message.header.stamp);
  EXPECT_EQ(back.header.frame_id, scan_message.header.frame_id);
  EXPECT_FLOAT_EQ(back.angle_min, scan_message.angle_min);
  EXPECT_FLOAT_EQ(back.angle_max, scan_message.angle_max);
  EXPECT_FLOAT_EQ(back.angle_increment, scan_message.angle_increment);
  EXPECT_FLOAT_EQ(back.time_increment, scan_message.time_increment);
  EXPECT_FLOAT_EQ(back.range_min, scan_message.range_min);
  EXPECT_FLOAT_EQ(back.range_max, scan_message.range_max);
  EXPECT_EQ(back.intensities, scan_message.intensities);
  ASSERT_EQ(back.ranges.size(), 5U);
  EXPECT_EQ(back.ranges[0], 1.0F);
  EXPECT_EQ(back.ranges[1], kInfinity);
  EXPECT_EQ(back.ranges[2], -kInfinity);
  EXPECT_TRUE(std::isnan(back.ranges[3]));
  EXPECT_EQ(back.ranges[4], 5.0F);
}

}  // namespace
}  // namespace sightline::bridge
