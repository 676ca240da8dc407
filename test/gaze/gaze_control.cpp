// The gaze as a whole: modes, their input, and what goes wrong.
#include "sightline/gaze/gaze_control.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sightline/motion/sensor_head.h"

namespace sightline::gaze {
namespace {

using geometry::Feature;
using geometry::FeatureBehaviour;
using geometry::FeatureKind;
using geometry::Pose2;

constexpr std::int64_t kStep = 20'000'000;  // between decisions [ns]

Feature cornerAt(std::uint32_t id, const Eigen::Vector2d& place) {
  Feature feature;
  feature.id = id;
  feature.position = place;
  feature.covariance = 1e-4 * Eigen::Matrix2d::Identity();
  feature.behaviour = FeatureBehaviour::kFixed;
  return feature;
}

// A robot that drives as it is told, with a head that obeys, or not.
class GazeControlTest : public testing::Test {
 protected:
  explicit GazeControlTest(const GazeConfig& config = {}) : gaze_(config), head_(config.head) {
    gaze_.setMounting({});
  }

  void run(double seconds) {
    for (const std::int64_t end = now_ + std::llround(1e9 * seconds); now_ < end;) step();
  }
  void step() {
    now_ += kStep;
    T_odom_base_ = T_odom_base_ * Pose2::exp(1e-9 * kStep * twist_);
    if (has_odometry_) gaze_.takeOdometry(now_, T_odom_base_);
    if (has_features_ && now_ % 100'000'000 == 0) tellFeatures();
    if (reports_) gaze_.takeHead(now_, head_.angle());
    const auto command = gaze_.decide(now_);
    if (command && obeys_) {
      EXPECT_EQ(config().head.fault(*command), "");
      head_.command(*command);
    }
    for (int i = 0; i < 20; ++i) head_.step(1e-3);
  }
  void tellFeatures() {
    for (Feature& feature : features_) {
      const bool is_seen = !is_hidden_ && inView(feature.position);
      feature.unseen = is_seen ? 0.0 : feature.unseen + 0.1;
    }
    gaze_.takeFeatures(now_, features_);
  }
  bool inView(const Eigen::Vector2d& place) const {
    return config().field.holds(T_odom_base_.inverse() * place, head_.angle());
  }
  const GazeConfig& config() const { return gaze_.config(); }
  const std::string& message() const { return gaze_.state().message; }
  GazeMode mode() const { return gaze_.state().mode; }

  GazeControl gaze_;
  motion::SensorHead head_;
  std::vector<Feature> features_{cornerAt(4, {1.5, 0.5}), cornerAt(7, {1.0, -1.0})};
  Pose2 T_odom_base_;
  Eigen::Vector3d twist_ = Eigen::Vector3d::Zero();
  std::int64_t now_ = 1'000'000'000;
  bool has_odometry_ = true, has_features_ = true, reports_ = true, obeys_ = true;
  bool is_hidden_ = false;
};

TEST_F(GazeControlTest, HoldsAtTheStart) {
  run(2.0);
  EXPECT_EQ(head_.angle(), 0.0);
  EXPECT_EQ(mode(), GazeMode::kHold);
  EXPECT_EQ(message(), "");
}

TEST_F(GazeControlTest, SweepsFromLimitToLimit) {
  gaze_.sweep();
  double least = 0.0, most = 0.0, fastest = 0.0;
  for (int i = 0; i < 500; ++i) {
    step();
    least = std::min(least, head_.angle());
    most = std::max(most, head_.angle());
    fastest = std::max(fastest, std::abs(head_.rate()));
  }
  EXPECT_NEAR(least, config().head.lower, 0.03);
  EXPECT_NEAR(most, config().head.upper, 0.03);
  EXPECT_NEAR(fastest, config().sweep_rate, 0.05);
  EXPECT_EQ(message(), "");
}

TEST_F(GazeControlTest, KeepsAFeatureInViewWhileTheRobotTurns) {
  run(0.3);
  ASSERT_TRUE(gaze_.fixate(4).success);
  run(0.7);
  twist_.z() = geometry::radians(60.0);
  for (int i = 0; i < 60; ++i) {
    step();
    EXPECT_TRUE(inView({1.5, 0.5}));
  }
  EXPECT_EQ(gaze_.state().target, 4U);
}

TEST_F(GazeControlTest, KeepsAFeatureInViewWhileTheRobotDrivesPast) {
  run(0.3);
  ASSERT_TRUE(gaze_.fixateNearestCorner().success);
  EXPECT_EQ(gaze_.state().target, 7U);
  run(0.7);
  twist_.x() = 0.5;
  for (int i = 0; i < 115; ++i) {
    step();
    EXPECT_TRUE(inView({1.0, -1.0}));
  }
}

TEST_F(GazeControlTest, LooksOnWhereAHiddenFeatureIs) {
  run(0.3);
  ASSERT_TRUE(gaze_.fixate(4).success);
  run(0.7);
  is_hidden_ = true;
  twist_.z() = 0.5;
  run(2.0);
  EXPECT_TRUE(gaze_.state().is_target_lost);
  EXPECT_TRUE(inView({1.5, 0.5}));
  is_hidden_ = false;
  run(0.2);
  EXPECT_FALSE(gaze_.state().is_target_lost);
}

TEST_F(GazeControlTest, FindsAFeatureAgainThatHasAnotherId) {
  run(0.3);
  ASSERT_TRUE(gaze_.fixate(4).success);
  features_[0].id = 12;
  features_[0].position += Eigen::Vector2d(0.01, 0.01);
  run(0.5);
  EXPECT_EQ(gaze_.state().target, 12U);
}

TEST_F(GazeControlTest, SearchesAroundAnUncertainPrediction) {
  run(0.3);
  ASSERT_TRUE(gaze_.fixate(4).success);
  run(0.5);
  is_hidden_ = true;
  features_[0].covariance = 0.09 * Eigen::Matrix2d::Identity();
  double least = 10.0, most = -10.0;
  for (int i = 0; i < 200; ++i) {
    step();
    least = std::min(least, head_.angle());
    most = std::max(most, head_.angle());
  }
  EXPECT_GT(most - least, 0.6);
}

TEST_F(GazeControlTest, GivesUpAFeatureThatIsNotFoundAgain) {
  run(0.3);
  ASSERT_TRUE(gaze_.fixate(4).success);
  features_.erase(features_.begin());
  run(21.0);
  EXPECT_EQ(mode(), GazeMode::kHold);
  EXPECT_EQ(message(), "the feature was not found again");
}

TEST_F(GazeControlTest, RefusesAFeatureThatIsNotThere) {
  run(0.3);
  const Fixated fixated = gaze_.fixate(99);
  EXPECT_FALSE(fixated.success);
  EXPECT_EQ(fixated.message, "there is no feature 99");
  EXPECT_EQ(mode(), GazeMode::kHold);
}

TEST_F(GazeControlTest, RefusesAClickOnNothing) {
  run(0.3);
  EXPECT_FALSE(gaze_.fixateAt({-3.0, 2.0}).success);
  EXPECT_TRUE(gaze_.fixateAt({1.55, 0.45}).success);
}

TEST_F(GazeControlTest, RefusesWhatIsOutOfReach) {
  features_ = {cornerAt(1, {9.0, 0.0}), cornerAt(2, {-1.5, 0.0})};
  run(0.3);
  EXPECT_EQ(gaze_.fixateNearestCorner().message, "there is no corner within reach");
  EXPECT_FALSE(gaze_.fixateMostInformative().success);
}

TEST_F(GazeControlTest, ChoosesTheFeatureThatSaysMost) {
  features_[1].covariance = 0.04 * Eigen::Matrix2d::Identity();
  run(0.3);
  const Fixated fixated = gaze_.fixateMostInformative();
  ASSERT_TRUE(fixated.success);
  EXPECT_EQ(fixated.id, 4U);
}

TEST_F(GazeControlTest, GoesToItsRestWithoutFreshInput) {
  run(0.3);
  ASSERT_TRUE(gaze_.fixate(7).success);
  run(0.7);
  EXPECT_LT(head_.angle(), -0.5);
  has_features_ = false;
  run(1.5);
  EXPECT_TRUE(gaze_.state().rests);
  EXPECT_EQ(message(), "no features");
  EXPECT_EQ(head_.angle(), config().rest);
  has_features_ = true;
  run(1.0);
  EXPECT_EQ(message(), "");
  EXPECT_LT(head_.angle(), -0.5);
  has_odometry_ = false;
  run(1.0);
  EXPECT_EQ(message(), "no odometry");
}

TEST_F(GazeControlTest, SaysWithinASecondThatTheHeadIsStuckAndHolds) {
  run(0.3);
  obeys_ = false;
  ASSERT_TRUE(gaze_.fixate(7).success);
  run(0.9);
  EXPECT_EQ(mode(), GazeMode::kHold);
  EXPECT_EQ(message(), "the head is stuck");
  // Until somebody tries again.
  obeys_ = true;
  run(2.0);
  EXPECT_EQ(message(), "the head is stuck");
  ASSERT_TRUE(gaze_.fixate(7).success);
  run(1.0);
  EXPECT_EQ(message(), "");
  EXPECT_LT(head_.angle(), -0.5);
}

TEST_F(GazeControlTest, SaysWithinASecondThatTheHeadDoesNotAnswer) {
  reports_ = false;
  gaze_.sweep();
  run(0.9);
  EXPECT_EQ(mode(), GazeMode::kHold);
  EXPECT_EQ(message(), "the head does not answer");
}

TEST_F(GazeControlTest, GoesOnWhenTheHeadAnswers) {
  reports_ = false;
  gaze_.sweep();
  run(2.0);
  EXPECT_EQ(message(), "the head does not answer");
  reports_ = true;
  run(1.0);
  EXPECT_EQ(mode(), GazeMode::kSweep);
  EXPECT_EQ(message(), "");
  ASSERT_TRUE(gaze_.fixateNearestCorner().success);
  reports_ = false;
  run(1.0);
  reports_ = true;
  run(1.0);
  EXPECT_EQ(gaze_.state().target, 7U);
}

TEST_F(GazeControlTest, HoldsWhereTheClockWasSetBack) {
  run(0.3);
  ASSERT_TRUE(gaze_.fixate(4).success);
  run(0.7);
  now_ = 100'000'000;
  run(0.2);
  EXPECT_EQ(mode(), GazeMode::kHold);
  EXPECT_EQ(message(), "the clock was set back");
  run(0.3);
  EXPECT_TRUE(gaze_.fixate(4).success);
}

TEST_F(GazeControlTest, SaysWhatTheModeInformLacks) {
  gaze_.inform();
  run(0.1);
  EXPECT_EQ(message(), "no map");
  world::RoomMap hall;
  hall.addRectangle("hall", {100.0, 100.0});
  gaze_.setMap(hall);
  run(0.1);
  EXPECT_EQ(message(), "no pose");
  gaze_.takePose(now_, {Pose2(), 0.01 * Eigen::Matrix3d::Identity()});
  run(0.1);
  EXPECT_EQ(message(), "no wall of the map is within reach");
  EXPECT_TRUE(gaze_.state().rests);
}

TEST_F(GazeControlTest, TurnsToWhatIsUncertain) {
  world::RoomMap room;
  room.addRectangle("room", {20.0, 3.0});
  gaze_.setMap(room);
  gaze_.inform();
  for (int i = 0; i < 6; ++i) {
    gaze_.takePose(now_, {Pose2(0.0, 0.0, 0.0), Eigen::Vector3d(1e-5, 0.04, 1e-5).asDiagonal()});
    run(0.1);
  }
  EXPECT_GT(std::abs(head_.angle()), 0.3);
  EXPECT_EQ(message(), "");
}

}  // namespace
}  // namespace sightline::gaze
