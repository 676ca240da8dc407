// Features over scans as the estimators make them: with wheels, without, and where the clock is
// set.
#include "sightline/pipeline/scan_features.h"

#include <gtest/gtest.h>

#include "lines/room_scan.h"
#include "sightline/lines/line_extractor.h"

namespace sightline::pipeline {
namespace {

using geometry::Pose2;

class ScanFeaturesTest : public testing::Test {
 protected:
  ScanFeaturesTest() { room_.walls = test::rectangle(-1.0, -2.5, 5.0, 2.0); }

  LocatedScan locatedAt(const Pose2& T_odom_base) {
    room_.pose = T_odom_base;
    LocatedScan located;
    located.scan = room_.take(gauss_);
    located.scan.stamp = stamp_ += 100'000'000;
    located.T_base_sensor = Pose2();
    located.T_odom_base = T_odom_base;
    return located;
  }
  std::optional<std::vector<geometry::Feature>> take(
      const LocatedScan& located,
      const std::optional<dead_reckoning::DeadReckoningUpdate>& odometry = std::nullopt) {
    lines_.segments = extractor_.extract(located.scan);
    return features_.take(located, odometry, lines_);
  }

  test::ScanOf room_;
  test::Gauss gauss_{3};
  lines::LineExtractor extractor_;
  ScanFeatures features_{lines::FeatureTrackerConfig()};
  Lines lines_;
  std::int64_t stamp_ = 0;
};

TEST_F(ScanFeaturesTest, StandStillInOdomAndNameTheWalls) {
  std::optional<std::vector<geometry::Feature>> features;
  for (int i = 0; i < 10; ++i) features = take(locatedAt(Pose2(0.05 * i, 0.0, 0.02 * i)));
  ASSERT_TRUE(features);
  int corners = 0;
  for (const auto& feature : *features) {
    corners += (feature.position - Eigen::Vector2d(5.0, 2.0)).norm() < 0.05 ? 1 : 0;
  }
  EXPECT_EQ(corners, 1);
  for (const auto& segment : lines_.segments) EXPECT_NE(segment.id, 0U);
}

TEST_F(ScanFeaturesTest, TakeTheStepOfTheDeadReckonerWithoutWheels) {
  std::optional<std::vector<geometry::Feature>> features;
  for (int i = 0; i < 10; ++i) {
    LocatedScan located = locatedAt(Pose2(0.05 * i, 0.0, 0.0));
    located.T_odom_base.reset();
    dead_reckoning::DeadReckoningUpdate odometry;
    odometry.pose.mean = Pose2(0.05 * i, 0.0, 0.0);
    odometry.step.covariance = 1e-6 * Eigen::Matrix3d::Identity();
    features = take(located, odometry);
  }
  ASSERT_TRUE(features);
  ASSERT_FALSE(features->empty());
  EXPECT_EQ(features->front().id, 1U);
}

TEST_F(ScanFeaturesTest, AreNoneWhereTheMotionOrTheMountingIsNotKnown) {
  LocatedScan located = locatedAt({});
  located.T_odom_base.reset();
  EXPECT_FALSE(take(located));
  located = locatedAt({});
  located.T_base_sensor.reset();
  EXPECT_FALSE(take(located));
  for (const auto& segment : lines_.segments) EXPECT_EQ(segment.id, 0U);
}

TEST_F(ScanFeaturesTest, BeginAnewWhereTheClockWasSet) {
  const auto before = take(locatedAt({}));
  ASSERT_TRUE(before && !before->empty());
  features_.restart();
  const auto after = take(locatedAt({}));
  ASSERT_TRUE(after && !after->empty());
  EXPECT_GT(after->front().id, before->back().id);
  EXPECT_EQ(after->front().sightings, 1U);
}

}  // namespace
}  // namespace sightline::pipeline
