#include "sightline/world/world.h"

#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace sightline::world {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Ray levelRay(double x, double y, double angle, double height = 1.0) {
  return {{x, y, height}, {std::cos(angle), std::sin(angle), 0.0}};
}

// Solves start + u (end − start) = origin + t direction for each segment, as a school book does.
std::optional<double> bruteForce(const World& world, const Ray& ray) {
  std::optional<double> nearest;
  for (const WorldSegment& s : world.segments()) {
    Eigen::Matrix2d system;
    system << ray.direction.head<2>(), s.segment.start - s.segment.end;
    if (std::abs(system.determinant()) < 1e-12) continue;
    const Vector2d solution = system.inverse() * (s.segment.start - ray.origin.head<2>());
    const double z = ray.origin.z() + solution[0] * ray.direction.z();
    if (solution[0] <= 0.0 || solution[1] < 0.0 || solution[1] > 1.0) continue;
    if (z < s.bottom || z > s.top) continue;
    if (!nearest || solution[0] < *nearest) nearest = solution[0];
  }
  return nearest;
}

World randomSegments(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  std::uniform_real_distribution<double> height(0.1, 2.0);
  World world;
  for (int i = 0; i < count; ++i) {
    const geometry::Segment segment{{place(random), place(random)}, {place(random), place(random)}};
    const double bottom = height(random) - 0.1;
    world.add(WorldSegment{segment, bottom, bottom + height(random), 0});
  }
  return world;
}

Ray randomRay(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  std::uniform_real_distribution<double> height(0.1, 2.0);
  std::uniform_real_distribution<double> angle(-geometry::kPi, geometry::kPi);
  const double pitch = 0.1 * angle(random);
  const double heading = angle(random);
  return {
      {place(random), place(random), height(random)},
      {std::cos(pitch) * std::cos(heading), std::cos(pitch) * std::sin(heading), std::sin(pitch)}};
}

TEST(WorldCast, AgreesWithBruteForceOverRandomSegments) {
  std::mt19937 random(1);
  int hits = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const World world = randomSegments(random, 40);
    for (int i = 0; i < 200; ++i) {
      const Ray ray = randomRay(random);
      const auto hit = world.cast(ray);
      const auto expected = bruteForce(world, ray);
      ASSERT_EQ(hit.has_value(), expected.has_value());
      if (!hit) continue;
      EXPECT_NEAR(hit->range, *expected, 1e-9);
      ++hits;
    }
  }
  EXPECT_GT(hits, 2000);
}

TEST(WorldCast, NamesTheSegmentItsMaterialAndTheIncidence) {
  World world;
  const auto glass = world.addMaterial({"glass", 0.1});
  world.add(WorldSegment{{{-1.0, -5.0}, {-1.0, 5.0}}, 0.0, 2.0, 0});
  world.add(WorldSegment{{{2.0, -5.0}, {2.0, 5.0}}, 0.0, 2.0, glass});
  const auto hit = world.cast(levelRay(0.0, 0.0, geometry::radians(60.0)));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range, 4.0, 1e-12);
  EXPECT_NEAR(hit->cos_incidence, 0.5, 1e-12);
  EXPECT_EQ(hit->material, glass);
  EXPECT_EQ(hit->segment, 1u);
}

TEST(WorldCast, SeesNothingInEmptySpaceBehindOrAlongAWall) {
  EXPECT_FALSE(World().cast(levelRay(0.0, 0.0, 0.3)));
  World world;
  world.add(WorldSegment{{{1.0, -1.0}, {1.0, 1.0}}, 0.0, 2.0, 0});
  EXPECT_FALSE(world.cast(levelRay(0.0, 0.0, geometry::kPi)));
  EXPECT_FALSE(world.cast({{1.0, -3.0, 1.0}, {0.0, 1.0, 0.0}}));
  EXPECT_FALSE(world.cast({{0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}}));
}

TEST(WorldCast, ClosedPolygonHasNoHoleAtItsCorners) {
  World world;
  const std::vector<Vector2d> corners{{-3.1, -2.2}, {4.3, -2.7}, {3.9, 1.7}, {-2.6, 2.9}};
  for (std::size_t i = 0; i < 4; ++i) {
    world.add(WorldSegment{{corners[i], corners[(i + 1) % 4]}, 0.0, 2.0, 0});
  }
  for (const Vector2d& corner : corners) {
    for (int step = -1000; step <= 1000; ++step) {
      const double angle = std::atan2(corner.y(), corner.x()) + 1e-15 * step;
      ASSERT_TRUE(world.cast(levelRay(0.0, 0.0, angle)));
    }
  }
}

TEST(WorldCast, PitchedRayPassesOverLowFurnitureAndMeetsTheFloor) {
  World world;
  world.add(WorldSegment{{{1.0, -1.0}, {1.0, 1.0}}, 0.0, 0.5, 0});
  world.add(WorldPlate{{}, 0.0, 0});
  const double pitch = geometry::radians(-10.0);
  const auto hit = world.cast({{0.0, 0.0, 1.2}, {std::cos(pitch), 0.0, std::sin(pitch)}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range, 1.2 / std::sin(-pitch), 1e-9);  // 6.91 m
  EXPECT_NEAR(hit->cos_incidence, std::sin(-pitch), 1e-12);
  EXPECT_FALSE(hit->segment);
}

TEST(WorldCast, PlateIsMetOnlyWithinItsCorners) {
  World world;
  world.add(WorldPlate{{{1.0, -1.0}, {2.0, -1.0}, {2.0, 1.0}, {1.0, 1.0}}, 0.7, 0});
  const Vector3d down = Vector3d(1.5, 0.0, -0.7).normalized();
  const auto hit = world.cast({{0.0, 0.0, 1.4}, down});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range, Vector3d(1.5, 0.0, -0.7).norm(), 1e-12);
  EXPECT_FALSE(world.cast({{0.0, 3.0, 1.4}, down}));
  EXPECT_FALSE(world.cast({{0.0, 0.0, 0.3}, down})) << "from below, going down";
}

TEST(WorldCast, DiscIsMetOnItsNearSide) {
  World world;
  world.add(WorldDisc{{3.0, 0.0}, 0.5, 0.0, 2.0, 0});
  EXPECT_NEAR(world.cast(levelRay(0.0, 0.0, 0.0))->range, 2.5, 1e-12);
  EXPECT_NEAR(world.cast(levelRay(0.0, 0.0, 0.0))->cos_incidence, 1.0, 1e-12);
  EXPECT_FALSE(world.cast(levelRay(0.0, 0.6, 0.0)));
  EXPECT_FALSE(world.cast(levelRay(0.0, 0.0, geometry::kPi)));
  EXPECT_FALSE(world.cast(levelRay(0.0, 0.0, 0.0, 2.1))) << "over it";
}

TEST(WorldCast, DiscIsMetFromAboveOnItsTop) {
  World world;
  world.add(WorldDisc{{1.0, 0.0}, 0.2, 0.0, 0.5, 0});
  const auto hit = world.cast({{0.0, 0.0, 1.5}, Vector3d(1.0, 0.0, -1.0).normalized()});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(hit->cos_incidence, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(world.cast({{1.1, 0.0, 1.5}, {0.0, 0.0, -1.0}})->range, 1.0, 1e-12);
}

TEST(WorldCast, HitsOfRandomDiscsLieOnTheirSurfaceAndNothingLiesBefore) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-8.0, 8.0);
  std::uniform_real_distribution<double> size(0.05, 0.6);
  World world;
  for (int i = 0; i < 30; ++i) {
    world.add(WorldDisc{{place(random), place(random)}, size(random), 0.0, 3.0 * size(random), 0});
  }
  const auto depth = [&](const Vector3d& p) {  // > 0 inside of a disc
    double deepest = -1e9;
    for (const WorldDisc& disc : world.discs()) {
      const double sideways = disc.radius - (p.head<2>() - disc.centre).norm();
      deepest = std::max(deepest, std::min({sideways, p.z() - disc.bottom, disc.top - p.z()}));
    }
    return deepest;
  };
  for (int i = 0; i < 500; ++i) {
    const Ray ray = randomRay(random);
    if (depth(ray.origin) > 0.0) continue;
    const auto hit = world.cast(ray);
    const double reach = hit ? hit->range : 20.0;
    if (hit) {
      EXPECT_NEAR(depth(ray.origin + hit->range * ray.direction), 0.0, 1e-9);
    }
    for (double t = 0.0; t < reach - 1e-6; t += 0.01) {
      ASSERT_LE(depth(ray.origin + t * ray.direction), 1e-9);
    }
  }
}

// Rays that stay within a strip meet the same with its shortlist as without.
TEST(WorldCast, ShortlistLeavesOutNothingThatItsRaysCanMeet) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  std::uniform_real_distribution<double> within(-0.2, 0.2);
  World world;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector2d start(place(random), place(random));
    world.add(WorldSegment{{start, start + Eigen::Vector2d(place(random), place(random)) / 5.0}});
  }
  std::size_t kept = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d origin(place(random), place(random), 1.0);
    const double heading = place(random);
    const Eigen::Vector3d along(std::cos(heading), std::sin(heading), 0.0);
    const Eigen::Vector3d across(-along.y(), along.x(), 0.0);
    const auto shortlist = world.shortlist({origin, along}, 0.2);
    kept += shortlist.segments.size();
    for (int k = 0; k < 10; ++k) {
      const Ray ray{origin + within(random) * across, along};
      const auto all = world.cast(ray);
      const auto some = world.cast(ray, shortlist);
      ASSERT_EQ(all.has_value(), some.has_value());
      if (all) {
        EXPECT_EQ(all->segment, some->segment);
      }
    }
  }
  EXPECT_LT(kept, 300u * 20u);
}

TEST(WorldMaterial, TheLastOfANameIsFound) {
  World world;
  EXPECT_EQ(world.findMaterial("plaster"), 0u);
  EXPECT_FALSE(world.findMaterial("cork"));
  world.addMaterial({"cork", 0.2});
  EXPECT_EQ(world.addMaterial({"cork", 0.3}), 2u);
  EXPECT_EQ(world.findMaterial("cork"), 2u);
}

}  // namespace
}  // namespace sightline::world
