#include "sightline/tracking/pose_belief.h"

#include <gtest/gtest.h>

#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

class PoseBeliefTest : public ::testing::Test {
 protected:
  void take(std::size_t on_wall, std::size_t beyond, const Pose2& T_odom_base) {
    ScanAgreement agreement;
    agreement.on_wall = on_wall;
    agreement.beyond = beyond;
    agreement.looked_at = 360;
    belief_.take(agreement, *geometry_, false, T_odom_base);
  }

  test::SimulatedRooms rooms_{"rooms:\n  box: {size: [6.0, 4.0]}\n"};
  std::shared_ptr<const scan::ScanGeometry> geometry_ = rooms_.look({}, 1).geometry();
  PoseBelief belief_{5.0};
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

TEST_F(PoseBeliefTest, NoEvidenceChangesNothing) {
  const double before = belief_.probability();
  for (int i = 0; i < 10; ++i) take(0, 0, {0.3 * i, 0.0, 0.0});
  EXPECT_NEAR(belief_.probability(), before, 1e-12);
}

}  // namespace
}  // namespace sightline::tracking
