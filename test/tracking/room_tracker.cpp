#include "sightline/tracking/room_tracker.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scan_edits.h"
#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

const char* const kTwoRooms = R"(
rooms:
  west: {size: [6.0, 4.0], pose: [0.0, 0.0, 0.0]}
  east: {size: [4.0, 4.0], pose: [5.1, 0.0, 0.0]}
doors:
  - {between: [west, east], at: [3.05, 0.0], width: 0.9}
)";

TrackerConfig exactMap() {
  TrackerConfig config;
  config.wall.position_sigma = 0.0;
  config.wall.direction_sigma = 0.0;
  return config;
}

// A robot in two rooms whose wheels say what the test wants.
class RoomTrackerTest : public ::testing::Test {
 protected:
  RoomTracker trackerAt(const Pose2& pose, const TrackerConfig& config = exactMap()) {
    RoomTracker tracker(config, rooms_.map);
    tracker.setPose({pose, Eigen::Vector3d(0.01, 0.01, 0.003).asDiagonal()});
    return tracker;
  }

  std::optional<TrackerUpdate> step(RoomTracker& tracker, const Pose2& truth,
                                    const Pose2& odometry) {
    stamp_ += 100'000'000;
    return tracker.update(rooms_.look(truth, stamp_), odometry, {});
  }

  static double distance(const TrackerUpdate& update, const Pose2& truth) {
    return (update.pose.mean.translation() - truth.translation()).norm();
  }

  test::SimulatedRooms rooms_{kTwoRooms};
  std::int64_t stamp_ = 0;
};

TEST_F(RoomTrackerTest, SaysNothingBeforeItHasAPose) {
  RoomTracker tracker(exactMap(), rooms_.map);
  EXPECT_FALSE(step(tracker, {}, {}));
}

TEST_F(RoomTrackerTest, PullsAVaguePoseIn) {
  const Pose2 truth(0.5, 0.4, 0.3);
  RoomTracker tracker = trackerAt({0.6, 0.3, 0.35});
  const auto update = step(tracker, truth, {});
  ASSERT_TRUE(update);
  EXPECT_LT(distance(*update, truth), 0.01);
  EXPECT_EQ(update->state, TrackerState::kTracking);
  EXPECT_EQ(update->room, "west");
  EXPECT_GT(update->quality, 0.9);
  EXPECT_TRUE(update->covariance_valid);
}

TEST_F(RoomTrackerTest, CovarianceOfOneScanHolds) {
  const Pose2 truth(0.5, 0.4, 0.3);
  double sum = 0.0;
  int inside = 0;
  constexpr int kTrials = 400;
  for (int i = 0; i < kTrials; ++i) {
    RoomTracker tracker = trackerAt({0.55, 0.36, 0.32});
    const auto update = step(tracker, truth, {});
    const Eigen::Vector3d error = update->pose.mean.coordinates() - truth.coordinates();
    const double nees = test::normalisedSquare<3>(error, update->pose.covariance);
    sum += nees;
    inside += nees <= 7.815 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kTrials, 3.0, 0.4);
  EXPECT_GT(inside, 0.92 * kTrials);
}

TEST_F(RoomTrackerTest, MapOdomIsComposedAtTheScan) {
  const Pose2 truth(0.5, 0.4, 0.3);
  const Pose2 odometry(7.0, -2.0, 1.9);
  RoomTracker tracker = trackerAt(truth);
  const auto update = step(tracker, truth, odometry);
  const Pose2 composed = update->T_map_odom * odometry;
  EXPECT_LT((composed.coordinates() - update->pose.mean.coordinates()).norm(), 1e-9);
}

TEST_F(RoomTrackerTest, LaserAwayFromTheRobotsCentre) {
  const Pose2 truth(0.5, 0.4, 0.3);
  const Pose2 T_base_laser(0.3, -0.1, 0.5);
  RoomTracker tracker = trackerAt({0.55, 0.36, 0.32});
  const auto update = tracker.update(rooms_.look(truth * T_base_laser, 1), {}, T_base_laser);
  EXPECT_LT(distance(*update, truth), 0.01);
  EXPECT_NEAR(update->pose.mean.theta(), truth.theta(), 0.01);
}

TEST_F(RoomTrackerTest, DrivesThroughTheDoorIntoTheNextRoom) {
  Pose2 truth(1.0, 0.0, 0.0);
  Pose2 odometry;
  RoomTracker tracker = trackerAt(truth);
  std::optional<TrackerUpdate> update;
  for (int i = 0; i < 90; ++i) {
    truth = truth * Pose2(0.04, 0.0, 0.0);
    odometry = odometry * Pose2(0.0392, 0.0, 0.0005);  // 2 % short, and turning
    update = step(tracker, truth, odometry);
    EXPECT_LT(distance(*update, truth), 0.05) << i;
  }
  EXPECT_EQ(update->room, "east");
}

TEST_F(RoomTrackerTest, ADoorAddsTheThresholdsUncertainty) {
  TrackerConfig config = exactMap();
  config.neighbours = false;
  Pose2 truth(2.9, 0.0, 0.0);
  const TrackingContext context{config, rooms_.map};
  PoseTrack track(context, {truth, Eigen::Vector3d(0.01, 0.01, 0.003).asDiagonal()}, 0);
  double largest = 0.0;
  double settled = 1.0;
  for (int i = 0; i < 20; ++i) {
    const scan::Scan scan = rooms_.look(truth, i);
    const auto update = track.update(context, {scan, truth, {}});
    // The scan after the change of room sees wider gates.
    for (const auto& wall : update->walls)
      largest = std::max(largest, i > 4 ? wall.gate.opening : 0.0);
    settled = std::min(settled, std::sqrt(update->pose.covariance(0, 0)));
    truth = truth * Pose2(0.02, 0.0, 0.0);
  }
  EXPECT_GT(largest, 2.9 * config.threshold_position_sigma);
  EXPECT_LT(settled, 0.02);
}

TEST_F(RoomTrackerTest, SurvivesASlipOfTheWheels) {
  const Pose2 truth(0.5, 0.4, 0.3);
  RoomTracker tracker = trackerAt(truth);
  step(tracker, truth, {});
  // The robot turned by 17° on the spot, and the wheels say nothing of it.
  const Pose2 turned(0.5, 0.4, 0.6);
  std::optional<TrackerUpdate> update;
  for (int i = 0; i < 3; ++i) update = step(tracker, turned, {});
  EXPECT_NEAR(update->pose.mean.theta(), 0.6, 0.02);
  EXPECT_LT(distance(*update, turned), 0.02);
}

TEST_F(RoomTrackerTest, SaysThatItIsLost) {
  RoomTracker tracker = trackerAt({0.5, 0.4, 0.3});
  scan::Scan scan = rooms_.look({0.5, 0.4, 0.3}, 1);
  for (std::size_t i = 0; i < scan.beams(); ++i)
    scan.setRange(i, 9.0);  // far beyond any wall of the room
  std::optional<TrackerUpdate> update;
  for (int i = 0; i < 12; ++i) {
    scan.stamp += 100'000'000;
    update = tracker.update(scan, {}, {});
  }
  EXPECT_EQ(update->state, TrackerState::kLost);
  EXPECT_FALSE(update->covariance_valid);
  EXPECT_TRUE(update->pose.mean.isFinite());
}

TEST_F(RoomTrackerTest, DoesNotWalkThroughWalls) {
  // Blind wheels carry the pose through the east wall two metres beside the door: it stays a pose
  // of the west room, and is called lost once it has left that for good.
  RoomTracker tracker = trackerAt({2.0, 1.6, 0.0});
  scan::Scan blind = rooms_.look({2.0, 1.6, 0.0}, 1);
  test::setKinds(blind, scan::ReturnKind::kInvalid);
  Pose2 odometry;
  std::optional<TrackerUpdate> update;
  for (int i = 0; i < 40; ++i) {
    blind.stamp += 100'000'000;
    odometry = odometry * Pose2(0.1, 0.0, 0.0);
    update = tracker.update(blind, odometry, {});
    EXPECT_EQ(update->room, "west");
  }
  EXPECT_EQ(update->state, TrackerState::kLost);
}

TEST_F(RoomTrackerTest, BlindDrivingIsDegradedNotLost) {
  RoomTracker tracker = trackerAt({0.5, 0.4, 0.3});
  scan::Scan scan = rooms_.look({0.5, 0.4, 0.3}, 1);
  test::setKinds(scan, scan::ReturnKind::kInvalid);
  Pose2 odometry;
  std::optional<TrackerUpdate> update;
  for (int i = 0; i < 200; ++i) {
    scan.stamp += 100'000'000;
    odometry = odometry * Pose2(0.0, 0.0, 0.5);
    update = tracker.update(scan, odometry, {});
  }
  EXPECT_EQ(update->state, TrackerState::kDegraded);
}

TEST_F(RoomTrackerTest, InflatesByHand) {
  const Pose2 truth(0.5, 0.4, 0.3);
  RoomTracker tracker = trackerAt(truth);
  step(tracker, truth, {});
  tracker.inflate(0.4, 0.1);
  const auto update = step(tracker, truth, {});
  EXPECT_GT(update->walls[0].gate.opening, 0.9) << "jensfelt's 400 mm open the gates";
  EXPECT_LT(distance(*update, truth), 0.02) << "and the walls close them again";
}

TEST_F(RoomTrackerTest, RoomCanBeSaid) {
  const Pose2 truth(2.9, 0.0, 0.0);
  const TrackerConfig config = exactMap();
  RoomTracker tracker = trackerAt(truth, config);
  const auto before = step(tracker, truth, {});
  EXPECT_EQ(before->room, "west");
  EXPECT_TRUE(tracker.setRoom("east"));
  EXPECT_FALSE(tracker.setRoom("cellar"));
  const auto after = step(tracker, truth, {});
  EXPECT_EQ(after->room, "east");
  // Walls of the room that was said come first, in gates as wide as after a threshold.
  EXPECT_EQ(after->walls[0].room, 1U);
  const double added = config.gate.sigmas * config.threshold_position_sigma;
  EXPECT_GT(after->walls[0].gate.opening, added);
  EXPECT_LT(before->walls[0].gate.opening, 1.2 * added + 0.1);
}

TEST_F(RoomTrackerTest, RefusesOldScansAndOdometryThatIsNotFinite) {
  const Pose2 truth(0.5, 0.4, 0.3);
  RoomTracker tracker = trackerAt(truth);
  ASSERT_TRUE(tracker.update(rooms_.look(truth, 1000), {}, {}));
  EXPECT_FALSE(tracker.update(rooms_.look(truth, 999), {}, {}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(tracker.update(rooms_.look(truth, 1001), {nan, 0.0, 0.0}, {}));
  EXPECT_TRUE(tracker.update(rooms_.look(truth, 1002), {}, {}));
  tracker.restartClock();
  EXPECT_TRUE(tracker.update(rooms_.look(truth, 1), {}, {}));
}

TEST_F(RoomTrackerTest, AnotherMethodGoesOnFromThePose) {
  const Pose2 truth(0.5, 0.4, 0.3);
  TrackerConfig config = exactMap();
  RoomTracker tracker = trackerAt({0.6, 0.3, 0.35}, config);
  step(tracker, truth, {});
  config.method = Method::kPlain;
  tracker.configure(config);
  const auto update = step(tracker, truth, {});
  ASSERT_TRUE(update);
  EXPECT_LT(distance(*update, truth), 0.02);
  EXPECT_FALSE(update->covariance_valid);
}

TEST_F(RoomTrackerTest, SaysWhyAWallWasRefused) {
  const Pose2 truth(0.5, 0.4, 0.3);
  TrackerConfig config = exactMap();
  config.wall.max_nis = 1.0;
  RoomTracker tracker = trackerAt(truth, config);
  int outside = 0;
  for (int i = 0; i < 20; ++i) {
    const auto update = step(tracker, truth, {});
    for (const WallUpdate& wall : update->walls) {
      EXPECT_EQ(wall.fit.has_value(), wall.innovation.has_value());
      EXPECT_EQ(wall.accepted(), wall.fit && wall.innovation->nis <= 1.0);
      outside += wall.refusal == WallRefusal::kOutsideGate ? 1 : 0;
    }
  }
  EXPECT_GT(outside, 5);
}

TEST_F(RoomTrackerTest, ConfigurationIsChecked) {
  TrackerConfig config;
  config.gate.sigmas = -1.0;
  EXPECT_THROW(RoomTracker(config, rooms_.map), config::Error);
}

}  // namespace
}  // namespace sightline::tracking
