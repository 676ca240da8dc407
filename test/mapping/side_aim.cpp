#include "sightline/mapping/side_aim.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sightline::mapping {
namespace {

// A key scan at the origin that sees a surface facing it along y = -1 between two places, so far
// before the wall.
KeyScan seen(double from, double to, double before) {
  KeyScan key;
  for (double x = from; x < to; x += 0.01) {
    dead_reckoning::SurfacePoint point;
    point.position = {x, -1.0 + before};
    point.normal = {0.0, 1.0};
    key.surfaces.points.push_back(point);
  }
  return key;
}

// The south side of a room of 4 x 2 m, which begins off and turned, after it was aimed at scans.
SideLine aimed(const std::vector<KeyScan>& keys, double off, double turn) {
  const std::vector<RoomOutline> found{rectangleOutline({0.0, 0.0}, 0.0, {4.0, 2.0})};
  std::vector<RoomOutline> rooms = found;
  rooms[0].sides[0].distance += off;
  rooms[0].sides[0].angle += turn;
  aimSides(keys, std::vector<geometry::Pose2>(keys.size()), found, rooms);
  return rooms[0].sides[0];
}

// To what counts as on the line, 2.5 cm; least squares does the rest from there, which alone would
// put the side across, from the wall to the cupboards, where these were seen often.
TEST(SideAim, IsTheWallThoughCupboardsStandBesideIt) {
  std::vector<KeyScan> keys{seen(-2.0, 0.3, 0.0)};
  keys.resize(8, seen(0.3, 2.0, 0.14));
  const SideLine side = aimed(keys, 0.05, 0.03);
  EXPECT_NEAR(side.distance, -1.0, 0.025);
  EXPECT_NEAR(side.angle, 0.5 * geometry::kPi, 0.0125);
}

TEST(SideAim, LeavesASideThatLiesWell) {
  const SideLine side = aimed({seen(-2.0, 2.0, 0.0)}, 0.003, 0.002);
  EXPECT_DOUBLE_EQ(side.distance, -1.0 + 0.003);
  EXPECT_DOUBLE_EQ(side.angle, 0.5 * geometry::kPi + 0.002);
}

TEST(SideAim, LeavesASideThatNobodySaw) {
  EXPECT_DOUBLE_EQ(aimed({}, 0.04, 0.03).angle, 0.5 * geometry::kPi + 0.03);
}

TEST(SideAim, FollowsAWallThatIsOutOfSquare) {
  std::vector<KeyScan> keys{seen(-2.0, 2.0, 0.0)};
  for (auto& point : keys[0].surfaces.points) point.position.y() += 0.02 * point.position.x();
  EXPECT_NEAR(aimed(keys, 0.0, -0.02).angle, 0.5 * geometry::kPi + 0.02, 0.0145);
}

}  // namespace
}  // namespace sightline::mapping
