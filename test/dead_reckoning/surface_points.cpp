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
