// A scanner with two bright targets, and one that sends no intensities, as bearing_detector sees
// them.
#include <cmath>

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <visualization_msgs/MarkerArray.h>

#include <sightline/BearingArray.h>
#include "nodes/comes_true.h"
#include "nodes/diagnostics.h"
#include "nodes/recorder.h"
#include "sightline/geometry/angle.h"

namespace sightline {
namespace {

sensor_msgs::LaserScan dullScan() {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time::now();
  scan.header.frame_id = "laser";
  scan.angle_min = static_cast<float>(geometry::radians(-90.0));
  scan.angle_max = static_cast<float>(geometry::radians(90.0));
  scan.angle_increment = static_cast<float>(geometry::radians(1.0));
  scan.range_min = 0.1F;
  scan.range_max = 30.0F;
  scan.ranges.assign(181, 3.0F);
  scan.intensities.assign(181, 2000.0F);
  return scan;
}

sensor_msgs::LaserScan brightScan() {
  sensor_msgs::LaserScan scan = dullScan();
  for (const std::size_t beam : {60U, 61U, 130U}) scan.intensities[beam] = 20000.0F;
  return scan;
}

TEST(BearingDetectorNode, PublishesASetForEachScanAndSaysWhatItMisses) {
  ros::NodeHandle node;
  const auto scans = node.advertise<sensor_msgs::LaserScan>("scan", 10);
  const auto blind_scans = node.advertise<sensor_msgs::LaserScan>("blind/scan", 10);
  const test::Recorder<BearingArray> bearings("bearings");
  const test::Recorder<BearingArray> none("blind/bearings");
  const test::Recorder<visualization_msgs::MarkerArray> markers("bearing_markers");
  const test::Diagnostics diagnostics;
  ASSERT_TRUE(test::comesTrue([&] {
    return scans.getNumSubscribers() > 0 && blind_scans.getNumSubscribers() > 0 &&
           bearings.publishers() > 0 && markers.publishers() > 0;
  }));
  bool is_dull = false;
  const auto send = [&] {
    scans.publish(is_dull ? dullScan() : brightScan());
    auto blind = brightScan();
    blind.intensities.clear();
    blind_scans.publish(blind);
    is_dull = !is_dull;
  };
  ASSERT_TRUE(test::comesTrue([&] { return bearings.count() >= 10; }, send));
  std::size_t empty = 0;
  for (const BearingArray& set : bearings.all()) {
    EXPECT_EQ(set.header.frame_id, "laser");
    EXPECT_NEAR(set.field_of_view_max, 0.5 * geometry::kPi, 1e-5);
    EXPECT_EQ(set.range_max, 5.0);
    if (set.bearings.empty()) {
      ++empty;
      continue;
    }
    ASSERT_EQ(set.bearings.size(), 2U);
    EXPECT_NEAR(set.bearings[0], geometry::radians(-29.5), 1e-5);
    EXPECT_NEAR(set.bearings[1], geometry::radians(40.0), 1e-5);
  }
  EXPECT_GE(empty, 4U) << "scans without a bearing are told, too";
  EXPECT_FALSE(markers.atLeast(1).empty());
  EXPECT_TRUE(test::comesTrue([&] {
    return diagnostics.text("blind/bearing_detector: bearings") == "scans without intensities" &&
           diagnostics.text("bearing_detector: bearings") == "detecting";
  })) << diagnostics.text("blind/bearing_detector: bearings");
  EXPECT_EQ(none.count(), 0U);
  const auto mend = [&] { blind_scans.publish(brightScan()); };
  EXPECT_TRUE(test::comesTrue(
      [&] { return diagnostics.text("blind/bearing_detector: bearings") == "detecting"; }, mend))
      << "once its scans have intensities";
}

}  // namespace
}  // namespace sightline
