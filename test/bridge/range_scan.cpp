#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sightline/bridge/head_command_conversion.h"
#include "sightline/bridge/range_scan_conversion.h"

namespace sightline::bridge {
namespace {

motion::RangeScan rangeScan() {
  motion::RangeScan range_scan;
  scan::Scan& scan = range_scan.scan;
  scan = scan::Scan(scan::ScanGeometry::uniform(-0.1, 0.1, 3, 4e-4, 0.4, 2.5), 12'000'000'345,
                    {1.0, 5.0, 2.0}, {26e-9, 1e-9, 6e-9});
  scan.frame = "projection";
  scan.setRangeVariances({1e-6, 0.0, 4e-4});
  range_scan.head.angles = {0.2, 0.21, 0.22};
  range_scan.head.mount_frame = "active_sensor";
  range_scan.head.origin = {0.05, -0.03};
  return range_scan;
}

std::string faultOf(const RangeScan& message) {
  RangeScanReader reader;
  try {
    reader.read(message);
  } catch (const scan::InvalidScan& fault) {
    return fault.what();
  }
  return "none";
}

TEST(RangeScanReader, ReadsWhatWasWritten) {
  const auto before = rangeScan();
  const auto after = RangeScanReader().read(toMessage(before));
  EXPECT_EQ(after.scan.stamp, before.scan.stamp);
  EXPECT_EQ(after.scan.frame, "projection");
  EXPECT_EQ(after.scan.kinds(), before.scan.kinds());
  EXPECT_EQ(after.scan.rangeVariances(), before.scan.rangeVariances());
  EXPECT_NEAR(after.scan.ranges()[2], 2.0, 1e-7);
  EXPECT_NEAR(after.scan.intensities()[0], 26e-9, 1e-14);
  EXPECT_EQ(after.head.angles, before.head.angles);
  EXPECT_EQ(after.head.origin, before.head.origin);
  EXPECT_EQ(after.head.mount_frame, "active_sensor");
  ASSERT_EQ(after.scan.sensorMotion().size(), 3u);
  EXPECT_NEAR(after.scan.sensorMotion()[2].theta(), 0.02, 1e-12);
  EXPECT_NEAR(after.scan.geometry()->timeOffsets()[2], 8e-4, 1e-9);
}

TEST(RangeScanReader, NamesWhatIsWrong) {
  const RangeScan good = toMessage(rangeScan());
  EXPECT_EQ(faultOf(good), "none");
  RangeScan bad = good;
  bad.variances.pop_back();
  EXPECT_EQ(faultOf(bad), "2 variances for 3 ranges");
  bad = good;
  bad.currents.clear();
  EXPECT_EQ(faultOf(bad), "0 currents for 3 ranges");
  bad = good;
  bad.head_angles.push_back(0.0);
  EXPECT_EQ(faultOf(bad), "4 head angles for 3 ranges");
  bad = good;
  bad.head_angles[1] = std::nan("");
  EXPECT_EQ(faultOf(bad), "a head angle that is not finite");
  bad = good;
  bad.origin_y = std::numeric_limits<double>::infinity();
  EXPECT_EQ(faultOf(bad), "an origin that is not finite");
  bad = good;
  bad.variances[2] = -1.0;
  EXPECT_EQ(faultOf(bad), "a variance of -1 m^2 at beam 2");
  bad = good;
  bad.variances[1] = std::nan("");  // nobody reads it: there is no range
  EXPECT_EQ(faultOf(bad), "none");
}

TEST(RangeScan, AsALaserScanIsTheSameScan) {
  const RangeScan message = toMessage(rangeScan());
  const auto scan = toLaserScan(message);
  EXPECT_EQ(scan.ranges, message.ranges);
  EXPECT_EQ(scan.time_increment, message.time_increment);
  EXPECT_NEAR(scan.intensities[0], 26.0F, 1e-4);
  EXPECT_EQ(scan.header.stamp, message.header.stamp);
}

TEST(HeadCommand, BecomesWhatTheServoShallDo) {
  HeadCommand message;
  message.mode = HeadCommand::POSITION;
  message.position = 0.3;
  const auto command = fromMessage(message, "head_joint", {});
  EXPECT_EQ(command.mode, motion::HeadCommand::Mode::kPosition);
  EXPECT_EQ(command.position, 0.3);
  message.joint = "elbow";
  EXPECT_THROW(fromMessage(message, "head_joint", {}), InvalidHeadCommand);
}

}  // namespace
}  // namespace sightline::bridge
