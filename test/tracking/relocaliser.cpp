#include "sightline/tracking/relocaliser.h"

#include <gtest/gtest.h>

#include "scan_edits.h"
#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

// A room of no symmetry, and a smaller one behind a door, at an angle to the axes of the map.
const char* const kCrooked = R"(
rooms:
  hall: {polygon: [[0, 0], [7, 0], [7, 3], [4, 3], [4, 5], [0, 5]], pose: [1.0, 2.0, 0.3]}
  closet: {size: [2.0, 2.4], pose: [9.3, 5.8, 0.3]}
)";

class RelocaliserTest : public ::testing::Test {
 protected:
  test::SimulatedRooms rooms_{kCrooked};
};

TEST_F(RelocaliserTest, FindsEveryPoseOfARoomWithoutSymmetry) {
  test::Gauss gauss(3);
  const Pose2 T_map_hall(1.0, 2.0, 0.3);
  const Pose2 T_base_sensor(0.2, -0.05, 0.4);
  for (int i = 0; i < 30; ++i) {
    const Pose2 truth =
        T_map_hall * Pose2(gauss.uniform(0.6, 3.4), gauss.uniform(0.6, 4.4), gauss.uniform(-3, 3));
    const auto found = relocalise(rooms_.map, rooms_.look(truth * T_base_sensor, 1), T_base_sensor);
    ASSERT_FALSE(found.empty()) << i;
    EXPECT_LT((found.front().T_map_base.translation() - truth.translation()).norm(), 0.03) << i;
    EXPECT_NEAR(geometry::wrapAngle(found.front().T_map_base.theta() - truth.theta()), 0.0, 0.01);
    EXPECT_EQ(found.front().room, 0U);
  }
}

TEST_F(RelocaliserTest, ListsTheTwinOfARectangle) {
  test::SimulatedRooms box("rooms:\n  box: {size: [6.0, 4.0]}\n");
  const Pose2 truth(1.0, 0.5, 0.7);
  const auto found = relocalise(box.map, box.look(truth, 1), {});
  ASSERT_GE(found.size(), 2U);
  const Pose2 twin(-1.0, -0.5, 0.7 - geometry::kPi);
  const bool first_is_true = areAlike(found[0].T_map_base, truth);
  EXPECT_TRUE(areAlike(found[0].T_map_base, first_is_true ? truth : twin));
  EXPECT_TRUE(areAlike(found[1].T_map_base, first_is_true ? twin : truth));
  EXPECT_NEAR(found[0].log_likelihood, found[1].log_likelihood, 0.5);
}

TEST_F(RelocaliserTest, CandidatesAreApartAndInOrder) {
  const auto found = relocalise(rooms_.map, rooms_.look({2.0, 3.5, 1.0}, 1), {});
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_LE(found[i].log_likelihood, found[i - 1].log_likelihood);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(areAlike(found[i].T_map_base, found[j].T_map_base));
    }
  }
}

TEST_F(RelocaliserTest, FindsNothingWithoutWalls) {
  scan::Scan blind = rooms_.look({2.0, 3.5, 1.0}, 1);
  test::setKinds(blind, scan::ReturnKind::kInvalid);
  EXPECT_TRUE(relocalise(rooms_.map, blind, {}).empty());
  EXPECT_TRUE(relocalise(rooms_.map, scan::Scan(), {}).empty());
  EXPECT_TRUE(relocalise(world::RoomMap(), rooms_.look({2.0, 3.5, 1.0}, 1), {}).empty());
}

}  // namespace
}  // namespace sightline::tracking
