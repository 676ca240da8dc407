#include "sightline/pipeline/body_mask.h"

#include <gtest/gtest.h>

#include "config_error.h"
#include "scan_feed_test.h"
#include "sightline/geometry/angle.h"

namespace sightline::pipeline {
namespace {

using geometry::radians;
using test::at;
using test::ScanFeedTest;

scan::Scan turn() {
  const auto geometry =
      scan::ScanGeometry::uniform(-geometry::kPi, radians(1.0), 360, 0.0, 0.1, 10.0);
  scan::Scan scan(geometry, 1'000'000'000, std::vector<double>(360, 2.0));
  scan.frame = "laser";
  return scan;
}

std::vector<double> masked(const scan::Scan& scan, double yaw) {
  std::vector<double> directions;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (scan.kinds()[i] != scan::ReturnKind::kInvalid) continue;
    directions.push_back(
        geometry::degrees(geometry::wrapAngle(scan.geometry()->angles()[i] + yaw)));
  }
  return directions;
}

TEST(BodyMask, LeavesOutSectorsInTheFrameOfTheBase) {
  for (const double yaw : {0.0, 1.0, -2.5}) {
    scan::Scan scan = turn();
    maskBody({radians(29.9), radians(60.1)}, geometry::Pose2(0.3, 0.1, yaw), scan);
    const auto directions = masked(scan, yaw);
    EXPECT_NEAR(static_cast<double>(directions.size()), 30.5, 1.0);
    for (const double direction : directions) {
      EXPECT_GT(direction, 29.0);
      EXPECT_LT(direction, 61.0);
    }
  }
}

TEST(BodyMask, SectorsMayWrapAround) {
  for (const auto& sector : {std::vector<double>{3.0, -3.0}, std::vector<double>{3.0, 3.2831853}}) {
    scan::Scan scan = turn();
    maskBody(sector, {}, scan);
    const auto directions = masked(scan, 0.0);
    EXPECT_NEAR(static_cast<double>(directions.size()), 17.0, 1.0);
    for (const double direction : directions) EXPECT_GT(std::abs(direction), 171.0);
  }
}

TEST(BodyMask, AnglesComeInPairs) {
  EXPECT_EQ(test::errorOf([] {
              checkSectors({{"laser", {1.0, 2.0, 3.0}}});
            }).reason(),
            "needs pairs of angles: [from, to, from, to]");
}

// Upside down the beams run the other way; the base is the same.
TEST_F(ScanFeedTest, MasksTheBodyOfAScannerThatHangsUpsideDown) {
  FeedConfig config;
  config.body["laser"] = {radians(9.9), radians(90.1)};
  start(config, {true, false});
  Eigen::Isometry3d mounting = Eigen::Isometry3d::Identity();
  mounting.linear() = Eigen::AngleAxisd(geometry::kPi, Eigen::Vector3d::UnitX()).matrix();
  transforms_.mount("laser", mounting);
  feed_->add(0, turn(), at(1.0));
  const auto results = all(1.1);
  ASSERT_EQ(results.size(), 1U);
  const auto directions = masked(results[0].located->scan, 0.0);
  EXPECT_NEAR(static_cast<double>(directions.size()), 81.0, 1.0);
  for (const double direction : directions) EXPECT_GT(direction, 8.0);
}

}  // namespace
}  // namespace sightline::pipeline
