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

// What the normals of a round wall err by is what they say: where they err by more, the wall looks
// as if it told the position along it.
TEST(SurfacePoints, NormalsOfARoundWallErrAsTheySay) {
  world::World world;
  const auto at = [](int i) {
    return Eigen::Vector2d(5.0 * std::cos(0.01 * i), 5.0 * std::sin(0.01 * i));
  };
  for (int i = 0; i < 629; ++i) {
    world::WorldSegment piece;
    piece.segment = {at(i), at(i + 1)};
    world.add(piece);
  }
  double squares = 0.0;
  double expected = 0.0;
  for (const double x : {0.0, 1.0, 2.0, 3.0}) {
    test::Viewer viewer(world, test::scanner(361), 3);
    const SurfaceScan seen = readSurfaces(viewer.look({x, 0.0, 0.3}, 0.0), {}, {0.0, 0.0, 0.0});
    const geometry::Pose2 pose(x, 0.0, 0.3);
    for (const SurfacePoint& point : seen.points) {
      const Eigen::Vector2d inwards = -(pose * point.position).normalized();
      const Eigen::Vector2d normal = pose.rotation() * point.normal;
      squares += (normal - inwards).squaredNorm();
      expected += point.normal_variance;
    }
  }
  EXPECT_LT(squares, 1.25 * expected);
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
