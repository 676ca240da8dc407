#include "sightline/tracking/plain_tracker.h"

#include <cmath>

#include <gtest/gtest.h>

#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;
using geometry::UncertainPose2;

const char* const kHouse = R"(
rooms:
  west: {size: [6.0, 4.0]}
  east: {size: [4.0, 4.0], pose: [5.1, 0.0, 0.0]}
doors: [{between: [west, east], at: [3.05, 0.0], width: 0.9}]
)";

UncertainPose2 startAt(const Pose2& pose) {
  return {pose, Eigen::Vector3d(0.01, 0.01, 0.003).asDiagonal()};
}

class PlainTrackerTest : public ::testing::Test {
 protected:
  TrackerUpdate step(PlainTracker& tracker, const Pose2& truth, const Pose2& odometry) {
    stamp_ += 100'000'000;
    const scan::Scan scan = rooms_.look(truth, stamp_);
    return tracker.update(context_, {scan, odometry, {}}).value();
  }

  test::SimulatedRooms rooms_{kHouse};
  TrackingContext context_{{}, rooms_.map};
  std::int64_t stamp_ = 0;
};

TEST_F(PlainTrackerTest, WallsPullThePoseIn) {
  const Pose2 truth(0.5, 0.4, 0.3);
  PlainTracker tracker(context_, startAt({0.6, 0.3, 0.35}), 0);
  const TrackerUpdate update = step(tracker, truth, {});
  EXPECT_LT((update.pose.mean.translation() - truth.translation()).norm(), 0.02);
  EXPECT_NEAR(update.pose.mean.theta(), 0.3, 0.01);
  int accepted = 0;
  for (const WallUpdate& wall : update.walls) accepted += wall.accepted() ? 1 : 0;
  EXPECT_GE(accepted, 3);
}

TEST_F(PlainTrackerTest, WallsCorrectWheelsThatErr) {
  Pose2 truth(-1.5, 0.5, 0.0);
  Pose2 odometry;
  PlainTracker tracker(context_, startAt(truth), 0);
  for (int i = 0; i < 80; ++i) {
    truth = truth * Pose2(0.04, 0.0, 0.0);
    odometry = odometry * Pose2(0.038, 0.0, 0.001);  // 5 % short, and turning by 1.4° a metre
    const TrackerUpdate update = step(tracker, truth, odometry);
    EXPECT_LT((update.pose.mean.translation() - truth.translation()).norm(), 0.06) << i;
    EXPECT_FALSE(update.covariance_valid) << "a floor is not a covariance to be believed";
  }
  // Wheels alone would be 16 cm short and turned by 4.6°.
}

TEST_F(PlainTrackerTest, LooksForTheWallsOfItsOwnRoomOnly) {
  PlainTracker tracker(context_, startAt({2.0, 0.0, 0.0}), 0);
  const TrackerUpdate update = step(tracker, {2.0, 0.0, 0.0}, {});
  EXPECT_EQ(update.walls.size(), 4U);
  for (const WallUpdate& wall : update.walls) EXPECT_EQ(wall.room, 0U);
}

TEST_F(PlainTrackerTest, UncertaintyNeverFallsBelowItsFloor) {
  const Pose2 truth(0.5, 0.4, 0.3);
  PlainTracker tracker(context_, startAt(truth), 0);
  TrackerUpdate update;
  for (int i = 0; i < 30; ++i) update = step(tracker, truth, {});
  const Eigen::Vector3d sigma = update.pose.covariance.diagonal().cwiseSqrt();
  EXPECT_DOUBLE_EQ(sigma[0], context_.config.plain.floor_position_sigma);
  EXPECT_DOUBLE_EQ(sigma[1], context_.config.plain.floor_position_sigma);
  EXPECT_DOUBLE_EQ(sigma[2], context_.config.plain.floor_heading_sigma);
}

TEST_F(PlainTrackerTest, AThresholdAddsToTheStandardDeviations) {
  Pose2 truth(2.9, 0.0, 0.0);
  PlainTracker tracker(context_, startAt(truth), 0);
  for (int i = 0; i < 40; ++i) {
    const TrackerUpdate update = step(tracker, truth, truth);
    const Eigen::Vector3d told = update.pose.covariance.diagonal().cwiseSqrt();
    const Eigen::Vector3d kept = tracker.pose().covariance.diagonal().cwiseSqrt();
    if (tracker.room() == 1 && update.room == "west") {
      EXPECT_NEAR(kept[0] - told[0], context_.config.threshold_position_sigma, 1e-12);
      EXPECT_NEAR(kept[2] - told[2], context_.config.threshold_heading_sigma, 1e-12);
      return;
    }
    EXPECT_EQ(kept, told);
    truth = truth * Pose2(0.02, 0.0, 0.0);
  }
  ADD_FAILURE() << "never came into the next room";
}

TEST(PlainFilter, AddsToStandardDeviationsByHand) {
  PlainFilter filter(startAt({1.0, 2.0, 0.3}));
  filter.inflate(0.4, 0.1);
  const Eigen::Vector3d sigma = filter.pose().covariance.diagonal().cwiseSqrt();
  EXPECT_NEAR(sigma[0], 0.1 + 0.4, 1e-12) << "jensfelt section 5.2, not the root of squares";
  EXPECT_NEAR(sigma[1], 0.1 + 0.4, 1e-12);
  EXPECT_NEAR(sigma[2], std::sqrt(0.003) + 0.1, 1e-12);
}

// jensfelt eqs 5 and 8: what is added does not depend on where the robot may have looked.
TEST(PlainFilter, PredictedCovarianceIsThatOfErrorsAddedToTheState) {
  const PlainConfig config;
  const UncertainPose2 start{{1.0, 2.0, 0.7}, Eigen::Vector3d(0.01, 0.02, 0.001).asDiagonal()};
  const Pose2 step(3.0, 0.4, 0.6);
  PlainFilter filter(start);
  filter.predict(config, step);
  test::Gauss gauss(3);
  test::Moments<3> moments;
  const double length = step.translation().norm();
  const Eigen::Vector3d nominal = (start.mean * step).coordinates() - start.mean.coordinates();
  for (int i = 0; i < 40000; ++i) {
    Eigen::Vector3d end = start.mean.coordinates() + gauss(start.covariance) + nominal;
    end.head<2>() += gauss(config.distance_sigma) * nominal.head<2>();
    end[2] += gauss(config.heading_sigma_per_metre * std::sqrt(length)) +
              gauss(config.steering_sigma * step.theta());
    moments.add(end);
  }
  EXPECT_LT(test::relativeError<3>(moments.covariance(), filter.pose().covariance), 0.03);
  EXPECT_LT((filter.pose().mean.coordinates() - moments.mean()).norm(), 0.01);
}

TEST(PlainFilter, DoesNotLetHeadingMoveThePosition) {
  PlainFilter filter({{0.0, 0.0, 0.0}, Eigen::Vector3d(0.0, 0.0, 0.01).asDiagonal()});
  filter.predict({}, {5.0, 0.0, 0.0});
  EXPECT_EQ(filter.pose().covariance(1, 1), 0.0) << "what the errata say is lost";
}

}  // namespace
}  // namespace sightline::tracking
