#include "sightline/dead_reckoning/surface_points.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulated_scans.h"

namespace sightline::dead_reckoning {
namespace {

SurfaceScan seenFrom(const world::World& world, const geometry::Pose2& pose) {
  test::Viewer viewer(world, test::scanner(181), 3);
  return readSurfaces(viewer.look(pose, 0.0), {}, Eigen::Vector3d::Zero());
}

// The last returns of both walls, with nothing beyond, have the same range wherever the robot is.
TEST(SurfacePoints, NoneOfAPlainCorridorFacesTheRobot) {
  for (const double x : {0.0, 0.1, 0.37}) {
    const SurfaceScan seen = seenFrom(test::plainCorridor(), {x, 0.2, 0.01});
    for (const SurfacePoint& point : seen.points) {
      EXPECT_LT(std::abs(point.normal.x()), 0.5) << point.position.transpose();
    }
  }
}

// Beams that are nearer to each other on a wall than they err: a few of them lie on a line that
// leads anywhere.
TEST(SurfacePoints, ANearWallHasOneDirection) {
  std::size_t points = 0;
  std::size_t off = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    test::Viewer viewer(test::plainCorridor(), test::scanner(721, geometry::kPi, 8.0), seed);
    const SurfaceScan seen =
        readSurfaces(viewer.look({0.0, 0.3, 0.0}, 0.0), {}, Eigen::Vector3d::Zero());
    for (const SurfacePoint& point : seen.points) {
      if (!point.hasNormal() || point.position.norm() > 1.5) continue;
      ++points;
      if (std::abs(point.normal.x()) > 0.4) ++off;
    }
  }
  EXPECT_LT(off, points / 100);
}

TEST(SurfacePoints, ALoneThingDownACorridorFacesTheRobot) {
  world::World world = test::plainCorridor();
  world.add(world::WorldDisc{{18.0, 0.0}, 0.2, {}});
  const SurfaceScan seen = seenFrom(world, {});
  EXPECT_TRUE(std::any_of(seen.points.begin(), seen.points.end(), [](const SurfacePoint& point) {
    return point.position.x() > 17.0 && point.normal.x() < -0.9;
  }));
}

}  // namespace
}  // namespace sightline::dead_reckoning
