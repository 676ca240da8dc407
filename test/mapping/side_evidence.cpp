#include "sightline/mapping/side_evidence.h"

#include <gtest/gtest.h>

namespace sightline::mapping {
namespace {

SideEvidence evidence(const std::string& bins) {
  SideEvidence evidence;
  for (const char bin : bins) {
    evidence.hits.push_back(bin == '#' ? 9 : 0);
    evidence.passes.push_back(bin == '.' ? 9 : 0);
    evidence.hidden.push_back(bin == '=' ? 12 : 0);
    if (bin == '=') evidence.hits.back() = 5;
  }
  return evidence;
}

TEST(SpansOf, AreWhereWallWasSeen) {
  const auto spans = spansOf(evidence("#####...######"), 0.7);
  ASSERT_EQ(spans.size(), 2U);
  EXPECT_NEAR(spans[0].from, 0.0, 1e-9);
  EXPECT_NEAR(spans[0].to, 0.25, 1e-9);
  EXPECT_NEAR(spans[1].from, 0.4, 1e-9);
  EXPECT_NEAR(spans[1].to, 0.7, 1e-9);
}

TEST(SpansOf, BridgeALittleThatNobodySaw) {
  EXPECT_EQ(spansOf(evidence("####???####"), 0.55).size(), 1U);
  EXPECT_EQ(spansOf(evidence("####.######"), 0.55).size(), 2U);
  EXPECT_EQ(spansOf(evidence("#####???????#####"), 0.85).size(), 2U);
}

TEST(SpansOf, LeaveOutWhatMostlyShowsAThingBeforeTheWall) {
  const auto spans = spansOf(evidence("#####======#####"), 0.8);
  ASSERT_EQ(spans.size(), 2U);
  EXPECT_NEAR(spans[0].to, 0.25, 1e-9);
  EXPECT_NEAR(spans[1].from, 0.55, 1e-9);
}

TEST(SpansOf, ShortPiecesAreNoWall) {
  EXPECT_TRUE(spansOf(evidence("..##......"), 0.5).empty());
}

TEST(RoomOutline, CornersAreWhereSidesMeet) {
  const RoomOutline room = rectangleOutline({1.0, 2.0}, 0.3, {4.0, 2.0});
  const geometry::Pose2 T_map_room(1.0, 2.0, 0.3);
  const Eigen::Vector2d corner = T_map_room * Eigen::Vector2d(-2.0, -1.0);
  EXPECT_LT((room.side(0).start - corner).norm(), 1e-12);
  EXPECT_NEAR(room.side(0).length(), 4.0, 1e-12);
  EXPECT_NEAR(room.side(1).length(), 2.0, 1e-12);
  EXPECT_NEAR(room.area(), 8.0, 1e-12);
  EXPECT_TRUE(room.contains(T_map_room * Eigen::Vector2d(1.9, 0.9)));
  EXPECT_FALSE(room.contains(T_map_room * Eigen::Vector2d(2.1, 0.9)));
}

}  // namespace
}  // namespace sightline::mapping
