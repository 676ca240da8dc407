#include "sightline/tracking/rival_tracks.h"

#include <gtest/gtest.h>

#include "scan_edits.h"
#include "sightline/tracking/room_tracker.h"
#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

const char* const kAsymmetricRooms = R"(
rooms:
  west: {size: [6.0, 4.0], pose: [0.0, 0.0, 0.0]}
  east: {size: [4.0, 4.0], pose: [5.1, 0.0, 0.0]}
doors:
  - {between: [west, east], at: [3.05, 0.8], width: 0.9}
)";

// A robot that drives and turns in two rooms and is told about all or nothing of it.
class RivalTracksTest : public ::testing::Test {
 protected:
  std::optional<TrackerUpdate> look() {
    stamp_ += 100'000'000;
    last_ = tracker_.update(rooms_.look(truth_, stamp_), odometry_, {});
    return last_;
  }

  std::optional<TrackerUpdate> go(const Pose2& step, int times) {
    for (int i = 0; i < times; ++i) {
      truth_ = truth_ * step;
      odometry_ = odometry_ * step;
      look();
    }
    return last_;
  }

  void startAt(const Pose2& pose, double position_sigma = 0.2) {
    const double variance = position_sigma * position_sigma;
    tracker_.setPose({pose, Eigen::Vector3d(variance, variance, 0.01).asDiagonal()});
  }

  static bool isAt(const std::optional<TrackerUpdate>& update, const Pose2& truth) {
    return update && areNear(update->pose.mean, truth);
  }
  static bool areNear(const Pose2& a, const Pose2& b) {
    return (a.translation() - b.translation()).norm() < 0.03 &&
           std::abs(geometry::wrapAngle(a.theta() - b.theta())) < 0.02;
  }

  test::SimulatedRooms rooms_{kAsymmetricRooms};
  RoomTracker tracker_{TrackerConfig(), rooms_.map};
  Pose2 truth_{-1.0, -0.6, 0.2};
  Pose2 odometry_;
  std::int64_t stamp_ = 0;
  std::optional<TrackerUpdate> last_;
};

TEST_F(RivalTracksTest, NeedsNoStartPoseButHasToMoveBeforeItClaimsOne) {
  EXPECT_FALSE(look());
  EXPECT_FALSE(tracker_.hasPose());
  EXPECT_FALSE(tracker_.rivals().empty());
  EXPECT_FALSE(go({}, 30)) << "standing still is no new evidence";
  const auto update = go({0.05, 0.0, 0.05}, 50);
  EXPECT_TRUE(isAt(update, truth_));
  EXPECT_EQ(update->state, TrackerState::kTracking);
  EXPECT_TRUE(tracker_.hasPose());
}

TEST_F(RivalTracksTest, KidnappingIsNoticedAtOnceAndClaimedLater) {
  startAt(truth_);
  EXPECT_EQ(look()->state, TrackerState::kTracking);
  truth_ = Pose2(5.6, -0.4, 2.0);
  EXPECT_NE(look()->state, TrackerState::kTracking);
  go({}, 3);
  const auto update = go({0.0, 0.0, 0.1}, 40);
  EXPECT_TRUE(isAt(update, truth_));
  EXPECT_EQ(update->state, TrackerState::kTracking);
  EXPECT_EQ(update->room, "east");
}

TEST_F(RivalTracksTest, UnreportedTurnsAreFound) {
  startAt(truth_);
  look();
  for (const double turn : {0.35, 0.8, 1.57, 3.1}) {
    truth_ = truth_ * Pose2(0.0, 0.0, turn);
    EXPECT_TRUE(isAt(look(), truth_)) << turn;
    go({0.0, 0.0, 0.1}, 40);
    EXPECT_EQ(last_->state, TrackerState::kTracking) << turn;
  }
}

TEST_F(RivalTracksTest, ATurnIsFoundWhereItHappenedHoweverFarTheWrongPoseHasRun) {
  startAt(truth_);
  go({0.05, 0.0, 0.0}, 45);
  ASSERT_EQ(last_->state, TrackerState::kTracking);
  const Pose2 run(0.6, 0.0, 0.0);
  truth_ = truth_ * Pose2(0.0, 0.0, geometry::kPi) * run;
  odometry_ = odometry_ * run;
  EXPECT_NE(look()->state, TrackerState::kTracking);
  EXPECT_TRUE(isAt(go({0.0, 0.0, 0.1}, 8), truth_)) << "a metre off, but a turn, no kidnapping";
}

TEST_F(RivalTracksTest, KidnappingOfARobotThatWasCertainIsFlaggedUntilTheOtherPoseHasProvenItself) {
  startAt(truth_);
  go({0.0, 0.0, 0.1}, 40);
  truth_ = Pose2(5.6, -0.4, 2.0);
  for (int i = 0; i < 60; ++i) {
    go({0.0, 0.0, 0.1}, 1);
    EXPECT_TRUE(isAt(last_, truth_) || last_->state != TrackerState::kTracking) << i;
  }
  EXPECT_TRUE(isAt(last_, truth_));
  EXPECT_EQ(last_->state, TrackerState::kTracking);
  EXPECT_EQ(last_->room, "east");
}

// The walls of west in the south and east are not there: the map is wrong, not the pose.
TEST_F(RivalTracksTest, APoseThatWasCertainIsKeptWhereTheMapIsWrong) {
  test::SimulatedRooms real(R"(
rooms:
  west: {size: [6.0, 4.0], walls: {south: {spans: [[0.0, 3.0]]}}}
  beyond: {size: [6.0, 3.0], pose: [0.0, -3.5, 0.0]}
doors:
  - {between: [west, beyond], at: [1.5, -2.0], width: 3.0}
)");
  startAt(truth_);
  go({0.0, 0.0, 0.1}, 40);
  for (int i = 0; i < 80; ++i) {
    const Pose2 step(0.02, 0.0, 0.05);
    truth_ = truth_ * step;
    odometry_ = odometry_ * step;
    stamp_ += 100'000'000;
    last_ = tracker_.update(real.look(truth_, stamp_), odometry_, {});
    EXPECT_TRUE(isAt(last_, truth_)) << i;
    EXPECT_NE(last_->state, TrackerState::kLost) << i;
  }
}

// People come before two thirds of the walls at once: nothing in the map explains it better.
TEST_F(RivalTracksTest, PeopleBeforeWallsDoNotTakeACertainPoseAway) {
  startAt(truth_);
  go({0.0, 0.0, 0.1}, 40);
  ASSERT_EQ(last_->state, TrackerState::kTracking);
  for (int i = 0; i < 10; ++i) {
    scan::Scan scan = rooms_.look(truth_, stamp_ += 100'000'000);
    for (std::size_t beam = scan.beams() / 3; beam < scan.beams(); ++beam) {
      scan.setRange(beam, 0.6 + 0.2 * std::sin(0.1 * static_cast<double>(beam)));
    }
    last_ = tracker_.update(scan, odometry_, {});
    EXPECT_TRUE(isAt(last_, truth_)) << i;
    EXPECT_EQ(last_->state, TrackerState::kTracking) << i;
  }
}

TEST_F(RivalTracksTest, TheTwinIsNotBelieved) {
  truth_ = Pose2(1.0, 0.4, 0.3);
  startAt({-1.0, -0.4, 0.3 - geometry::kPi});
  const auto update = look();
  EXPECT_FALSE(update->state == TrackerState::kTracking && !isAt(update, truth_));
  go({0.0, 0.0, 0.1}, 40);
  EXPECT_TRUE(isAt(last_, truth_));
  EXPECT_EQ(last_->state, TrackerState::kTracking);
}

// The start is told, and half of what is seen stands along a wall or before one: neither the shelf
// nor a place elsewhere that meets more walls takes the robot away.
TEST_F(RivalTracksTest, FurnitureAlongWallsDoesNotTakeATrueStartAway) {
  const char* const room = "rooms: {hall: {size: [6.0, 4.0]}}";
  test::SimulatedRooms furnished(R"(
rooms: {hall: {polygon: [[-3, -2], [3, -2], [3, 2], [2.2, 2], [2.2, 1.7], [-2.5, 1.7], [-2.5, 2], [-3, 2]]}}
)");
  RoomTracker tracker(TrackerConfig(), world::RoomMap(config::Node::parse(room, "room")));
  truth_ = Pose2(-0.6, 0.8, 2.6);
  tracker.setPose({truth_, Eigen::Vector3d(0.09, 0.09, 0.01).asDiagonal()});
  for (int i = 0; i < 80; ++i) {
    stamp_ += 100'000'000;
    last_ = tracker.update(furnished.look(truth_, stamp_), odometry_, {});
    EXPECT_TRUE(isAt(last_, truth_)) << i;
    truth_ = truth_ * Pose2(0.03, 0.0, 0.03);
    odometry_ = odometry_ * Pose2(0.03, 0.0, 0.03);
  }
}

TEST_F(RivalTracksTest, AVagueStartIsSearchedFor) {
  startAt({0.0, 0.0, 0.0}, 4.0);
  EXPECT_FALSE(look());
  EXPECT_TRUE(isAt(go({0.05, 0.0, 0.05}, 50), truth_));
}

TEST_F(RivalTracksTest, RivalsHaveProbabilitiesThatSumUpToOne) {
  look();
  double sum = 0.0;
  for (const RivalPose& rival : tracker_.rivals()) sum += rival.probability;
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST_F(RivalTracksTest, RelocalisesOnDemand) {
  startAt(truth_);
  look();
  EXPECT_TRUE(tracker_.relocalise());
  EXPECT_FALSE(tracker_.hasPose());
  EXPECT_TRUE(isAt(go({0.05, 0.0, 0.05}, 50), truth_));
}

TEST_F(RivalTracksTest, ThePlainMethodCannot) {
  TrackerConfig config;
  config.method = Method::kPlain;
  tracker_.configure(config);
  EXPECT_FALSE(tracker_.relocalise());
  EXPECT_FALSE(look());
  startAt(truth_);
  EXPECT_TRUE(look());
}

TEST_F(RivalTracksTest, SlippingWheelsDoNotPullThePose) {
  startAt(truth_);
  go({0.04, 0.0, 0.0}, 10);
  for (int i = 0; i < 6; ++i) {
    truth_ = truth_ * Pose2(0.04, 0.0, 0.0);
    odometry_ = odometry_ * Pose2(0.12, 0.0, 0.0);
    EXPECT_TRUE(isAt(look(), truth_)) << i;
    EXPECT_EQ(last_->state, TrackerState::kTracking) << i;
  }
}

}  // namespace
}  // namespace sightline::tracking
