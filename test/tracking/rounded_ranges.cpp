#include "sightline/tracking/rounded_ranges.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sightline/tracking/wall_finder.h"
#include "simulated_room.h"

namespace sightline::tracking {
namespace {

using geometry::Pose2;

// A scanner whose clock counts 50 mm, as in jensfelt section 2.
simulation::ScannerProfile coarseProfile() {
  auto profile = test::SimulatedRooms::profile();
  profile.noise.kind = scan::NoiseKind::kUniform;
  profile.noise.range_half_width = 0.025;
  profile.noise.angle_half_width = geometry::radians(0.25);
  return profile;
}

std::vector<BeamPoint> pointsWith(const std::vector<double>& ranges) {
  std::vector<BeamPoint> points(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    points[i].beam = i;
    points[i].range = ranges[i];
    points[i].position = ranges[i] * Eigen::Vector2d(std::cos(0.01 * i), std::sin(0.01 * i));
    points[i].covariance = 2e-4 * Eigen::Matrix2d::Identity();
  }
  return points;
}

std::vector<const BeamPoint*> allOf(const std::vector<BeamPoint>& points) {
  std::vector<const BeamPoint*> pointers;
  for (const BeamPoint& point : points) pointers.push_back(&point);
  return pointers;
}

TEST(RoundedRanges, WhatReadsTheSameIsRoundedAlike) {
  const auto fine = pointsWith({1.001, 1.003, 1.002, 1.004});
  EXPECT_DOUBLE_EQ(roundedAlike(allOf(fine)), 0.0);
  const auto one_step = pointsWith(std::vector<double>(9, 1.0));
  EXPECT_DOUBLE_EQ(roundedAlike(allOf(one_step)), 8.0) << "nine beams are one reading";
  const auto jittering = pointsWith({1.0, 1.0, 1.05, 1.0, 1.05, 1.05});
  EXPECT_DOUBLE_EQ(roundedAlike(allOf(jittering)), 1.0) << "two steps";
}

TEST(RoundedRanges, NoiseBeyondTheRoundingIsIndependent) {
  auto points = pointsWith({1.0, 1.01, 1.0, 1.0, 1.01, 1.01});
  EXPECT_DOUBLE_EQ(roundedAlike(allOf(points)), 0.0) << "a hundredth, by 1.4 cm of noise";
}

TEST(RoundedRanges, EdgesLieBetweenSteps) {
  const auto points = pointsWith({1.0, 1.0, 1.05, 1.05, 1.1});
  const auto edges = stepEdges(allOf(points));
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_NEAR(edges[0].position.norm(), 1.025, 1e-3);
  EXPECT_NEAR(edges[1].position.norm(), 1.075, 1e-3);
}

// A short piece of wall nearby, from all places before it: the saw would turn it by degrees.
TEST(RoundedRangesStatistics, AShortWallKeepsItsDirection) {
  const TrackerConfig config;
  const world::RoomMap map(config::Node::parse(
      "rooms: {hall: {size: [6.0, 4.0], walls: {north: {spans: [[2.2, 2.6]]}}}}", "rooms"));
  simulation::Scanner scanner(coarseProfile(), {}, 1);
  const world::World world = world::World::of(map);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double square = 0.0;
  double nees = 0.0;
  int found = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose2 truth(unit(random), 0.9 + 0.4 * unit(random), 1.2 + unit(random));
    const scan::Scan scan = scanner.sweep(world, i + 1, [&](std::int64_t) { return truth; });
    const PoseFilter filter(config.odometry,
                            {truth, Eigen::Vector3d(1e-4, 1e-4, 1e-3).asDiagonal()});
    const auto walls = WallFinder(config).find(filter, map, {{0, 2}}, readSweep(scan, {}));
    if (!walls.front().front().fit) continue;
    const auto& line = walls.front().front().fit->line;
    const auto expected =
        geometry::transform(truth.inverse(), map.rooms()[0].walls[2].segment.line());
    const double error = geometry::difference(line, expected)[1];
    square += error * error;
    nees += error * error / line.covariance(1, 1);
    ++found;
  }
  ASSERT_GT(found, 200);
  EXPECT_LT(geometry::degrees(std::sqrt(square / found)), 2.3);
  EXPECT_LT(nees / found, 1.3);
}

}  // namespace
}  // namespace sightline::tracking
