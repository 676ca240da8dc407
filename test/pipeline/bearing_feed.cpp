#include "sightline/pipeline/bearing_feed.h"

#include <gtest/gtest.h>

namespace sightline::pipeline {
namespace {

constexpr std::int64_t kLookMillisecond = 1'000'000;
constexpr std::int64_t kFirstLook = 100'000 * kLookMillisecond;

/// Knows one transform, that of `laser` in `map`, from a time on.
class OneTransform : public Transforms {
 public:
  std::optional<Eigen::Isometry3d> at(const std::string& target, const std::string& source,
                                      std::int64_t stamp) const override {
    if (target != "map" || source != "laser" || stamp < kFirstLook) return std::nullopt;
    Eigen::Isometry3d T_map_laser = Eigen::Isometry3d::Identity();
    T_map_laser.translation() << 1.0, 2.0, 0.3;
    return T_map_laser;
  }
  std::optional<Newest> newest(const std::string&, const std::string&) const override {
    return std::nullopt;
  }
};

ArrivedLook arrivedLook(const std::string& robot, std::int64_t stamp, std::int64_t arrival,
                        const std::string& frame = "laser") {
  ArrivedLook look{robot, frame, {}, arrival};
  look.set.stamp = stamp;
  return look;
}

geometry::UncertainPose2 poseOfRed(double x, double theta = 0.0) {
  return {geometry::Pose2(x, 0.0, theta), 0.01 * Eigen::Matrix3d::Identity()};
}

TEST(BearingFeed, WaitsForThePoseAndInterpolates) {
  const OneTransform transforms;
  BearingFeed feed({}, transforms);
  feed.addPose("red", kFirstLook, poseOfRed(0.0));
  feed.add(
      arrivedLook("red", kFirstLook + 60 * kLookMillisecond, kFirstLook + 60 * kLookMillisecond));
  EXPECT_TRUE(feed.ready(kFirstLook + 60 * kLookMillisecond).empty());
  EXPECT_EQ(feed.waiting(), 1U);
  feed.addPose("red", kFirstLook + 100 * kLookMillisecond, poseOfRed(1.0, 0.2));
  const auto ready = feed.ready(kFirstLook + 100 * kLookMillisecond);
  ASSERT_EQ(ready.size(), 1U);
  EXPECT_EQ(ready[0].fault, "");
  EXPECT_NEAR(ready[0].set.T_map_sensor.mean.x(), 0.6, 0.02);
  EXPECT_NEAR(ready[0].set.T_map_sensor.covariance(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(ready[0].set.turn_rate, 2.0, 1e-6);
}

TEST(BearingFeed, GivesUpWhatHasNoPose) {
  const OneTransform transforms;
  BearingFeed feed({}, transforms);
  feed.add(arrivedLook("red", kFirstLook, kFirstLook));
  EXPECT_TRUE(feed.ready(kFirstLook + 400 * kLookMillisecond).empty());
  const auto ready = feed.ready(kFirstLook + 500 * kLookMillisecond);
  ASSERT_EQ(ready.size(), 1U);
  EXPECT_EQ(ready[0].fault, "no pose of the sensor at its stamp");
  EXPECT_EQ(feed.waiting(), 0U);
}

TEST(BearingFeed, DoesNotInterpolateAcrossALongGap) {
  const OneTransform transforms;
  BearingFeed feed({}, transforms);
  feed.addPose("red", kFirstLook, poseOfRed(0.0));
  feed.addPose("red", kFirstLook + 3000 * kLookMillisecond, poseOfRed(3.0));
  feed.add(arrivedLook("red", kFirstLook + 1000 * kLookMillisecond, kFirstLook));
  const auto ready = feed.ready(kFirstLook + 3000 * kLookMillisecond);
  ASSERT_EQ(ready.size(), 1U);
  EXPECT_NE(ready[0].fault, "");
}

TEST(BearingFeed, HandsLooksOutInTheOrderOfTheirStamps) {
  const OneTransform transforms;
  BearingTopics topics;
  topics.pose_topic = "";
  BearingFeed feed(topics, transforms);
  feed.add(arrivedLook("red", kFirstLook + 20, kFirstLook));
  feed.add(arrivedLook("blue", kFirstLook + 10, kFirstLook));
  const auto ready = feed.ready(kFirstLook);
  ASSERT_EQ(ready.size(), 2U);
  EXPECT_EQ(ready[0].robot, "blue");
  EXPECT_EQ(ready[1].set.T_map_sensor.mean.y(), 2.0);
}

TEST(BearingFeed, NoticesTwoSensorsUnderOneName) {
  const OneTransform transforms;
  BearingTopics topics;
  topics.pose_topic = "";
  BearingFeed feed(topics, transforms);
  feed.add(arrivedLook("red", kFirstLook, kFirstLook));
  feed.add(arrivedLook("red", kFirstLook + 1, kFirstLook, "other"));
  const auto ready = feed.ready(kFirstLook);
  ASSERT_EQ(ready.size(), 2U);
  EXPECT_EQ(ready[1].fault, "two sensors under one name: laser, other");
}

}  // namespace
}  // namespace sightline::pipeline
