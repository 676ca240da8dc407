#include "sightline/tracking/pose_belief.h"

#include <gtest/gtest.h>

#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

class PoseBeliefTest : public ::testing::Test {
 protected:
  void take(std::size_t on_wall, std::size_t beyond, const Pose2& T_odom_base,
            std::size_t occluded = 0, bool jumped = false) {
    TrackerUpdate update;
    update.agreement.on_wall = on_wall;
    update.agreement.beyond = beyond;
    update.agreement.occluded = occluded;
    update.agreement.looked_at = 360;
    update.jumped = jumped;
    belief_.take(update, *geometry_, T_odom_base);
    last_ = update;
  }

  test::SimulatedRooms rooms_{"rooms:\n  box: {size: [6.0, 4.0]}\n"};
  std::shared_ptr<const scan::ScanGeometry> geometry_ = rooms_.look({}, 1).geometry();
  PoseBelief belief_{5.0};
  TrackerUpdate last_;
};

TEST_F(PoseBeliefTest, StandingBeforeADoorThatIsDrawnAsWallIsOneDisagreement) {
  take(60, 30, {});
  const double once = belief_.probability();
  EXPECT_TRUE(belief_.isContradicted());
  for (int i = 0; i < 100; ++i) take(60, 30, {0.001 * i, 0.0, 0.0});
  EXPECT_NEAR(belief_.probability(), once, 1e-12);
}

TEST_F(PoseBeliefTest, SoManyViewsAreNot) {
  for (int i = 0; i < 20; ++i) take(60, 30, {0.3 * i, 0.0, 0.0});
  EXPECT_LT(belief_.probability(), 0.1);
  for (int i = 20; i < 40; ++i) take(200, 0, {0.3 * i, 0.0, 0.0});
  EXPECT_GT(belief_.probability(), 0.99);
}

TEST_F(PoseBeliefTest, AScanThroughAllWallsIsEnoughToDoubt) {
  take(20, 200, {});
  EXPECT_LT(belief_.probability(), 0.1);
}

// The robot was carried to a place of which a third fits: at the first scan, and though views there
// speak for it, too.
TEST_F(PoseBeliefTest, FarFewerWallsThanUsualAreASurpriseThatLasts) {
  for (int i = 0; i < 20; ++i) take(355, 0, {0.3 * i, 0.0, 0.0});
  EXPECT_FALSE(belief_.isSurprised());
  take(120, 0, {6.0, 0.0, 0.0}, 235);
  EXPECT_TRUE(belief_.isSurprised());
  EXPECT_LT(belief_.probability(), 0.9);
  for (int i = 1; i < 10; ++i) take(120, 0, {6.0 + 0.3 * i, 0.0, 0.0}, 235);
  EXPECT_TRUE(belief_.isSurprised());
  EXPECT_LT(belief_.probability(), 0.9);
  EXPECT_GT(belief_.probability(), 0.5) << "it counts once";
  for (int i = 10; i < 15; ++i) take(355, 0, {6.0 + 0.3 * i, 0.0, 0.0});
  EXPECT_FALSE(belief_.isSurprised());
  EXPECT_GT(belief_.probability(), 0.99);
}

TEST_F(PoseBeliefTest, ASurpriseIsDismissedForTheViewWhileNothingGoesThroughWalls) {
  for (int i = 0; i < 20; ++i) take(355, 0, {0.3 * i, 0.0, 0.0});
  take(120, 0, {6.5, 0.0, 0.0}, 235);
  belief_.dismissSurprise(last_, *geometry_);
  EXPECT_FALSE(belief_.isSurprised());
  EXPECT_GT(belief_.probability(), 0.99);
  take(110, 0, {6.6, 0.0, 0.0}, 245);
  EXPECT_GT(belief_.probability(), 0.99);
  take(100, 20, {6.7, 0.0, 0.0}, 235);
  EXPECT_TRUE(belief_.isSurprised());
  EXPECT_LT(belief_.probability(), 0.9);
}

TEST_F(PoseBeliefTest, OnlyNarrowGatesTellThatAPoseIsAsPredicted) {
  take(120, 0, {}, 235);
  EXPECT_FALSE(isAsPredicted(last_, *geometry_)) << "no wall corrects the pose";
  WallUpdate wall;
  wall.fit = FittedLine();
  wall.fit->accepted_beams.resize(100);
  wall.refusal = WallRefusal::kNone;
  wall.gate.opening = 0.08;
  last_.walls = {wall};
  EXPECT_TRUE(isAsPredicted(last_, *geometry_));
  last_.walls.front().gate.opening = 0.6;
  EXPECT_FALSE(isAsPredicted(last_, *geometry_)) << "as after a slip";
}

TEST_F(PoseBeliefTest, ClutterThatComesAndGoesIsNone) {
  for (int i = 0; i < 40; ++i) {
    take(i % 10 < 5 ? 80 : 30, 0, {0.1 * i, 0.0, 0.0}, i % 10 < 5 ? 280 : 330);
    EXPECT_FALSE(belief_.isSurprised()) << i;
  }
}

TEST_F(PoseBeliefTest, AJumpIsDoubtedUntilTheNextViews) {
  for (int i = 0; i < 20; ++i) take(200, 0, {0.3 * i, 0.0, 0.0});
  take(60, 0, {6.0, 0.0, 0.0}, 140, true);
  EXPECT_LT(belief_.probability(), 0.9);
  for (int i = 1; i < 3; ++i) take(200, 0, {6.0 + 0.3 * i, 0.0, 0.0});
  EXPECT_GT(belief_.probability(), 0.95);
}

TEST_F(PoseBeliefTest, NoEvidenceChangesNothing) {
  const double before = belief_.probability();
  for (int i = 0; i < 10; ++i) take(0, 0, {0.3 * i, 0.0, 0.0});
  EXPECT_NEAR(belief_.probability(), before, 1e-12);
}

}  // namespace
}  // namespace sightline::tracking
