#include "sightline/tracking/key_scans.h"

#include <gtest/gtest.h>

#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

const char* const kViewedHall = R"(
rooms:
  hall: {size: [6.0, 4.0]}
)";

class KeyScansTest : public ::testing::Test {
 protected:
  TrackerInput at(const Pose2& T_odom_base) const { return {scan_, T_odom_base, {}}; }

  test::SimulatedRooms rooms_{kViewedHall};
  scan::Scan scan_ = rooms_.look({0.5, 0.3, 0.4}, 1);
  KeyScans keys_;
};

TEST_F(KeyScansTest, OneOfTheSameViewTakesThePlaceOfTheLast) {
  EXPECT_TRUE(keys_.isNew(at({})));
  keys_.add(at({}));
  EXPECT_FALSE(keys_.isNew(at({0.2, 0.0, 0.1})));
  EXPECT_TRUE(keys_.isNew(at({0.4, 0.0, 0.0})));
}

TEST_F(KeyScansTest, AViewDoesNotMoveWithTheScansThatItKeeps) {
  keys_.add(at({}));
  keys_.add(at({0.0, 0.0, 0.3}));
  EXPECT_TRUE(keys_.isNew(at({0.0, 0.0, 0.4})));
}

}  // namespace
}  // namespace sightline::tracking
