#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "dead_reckoning/simulated_scans.h"
#include "sightline/dead_reckoning/angle_histogram.h"
#include "sightline/dead_reckoning/correlative_search.h"
#include "sightline/dead_reckoning/histogram_matcher.h"
#include "sightline/dead_reckoning/pose_space.h"
#include "sightline/dead_reckoning/range_profile.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/dead_reckoning/translation_search.h"
#include "sightline/geometry/angle.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;
using test::Viewer;

SurfaceScan surfacesFrom(Viewer& viewer, const Pose2& pose) {
  return readSurfaces(viewer.look(pose, 0.0), Pose2(), Eigen::Vector3d::Zero());
}

TEST(IterativeSearch, FollowsTwoSquaresToTheGridsMinimum) {
  const Eigen::Vector2d least(0.47, -0.81);
  const auto cost = [&](const Eigen::Vector2d& p, double) { return (p - least).norm(); };
  const Minimum found = searchIteratively(cost, Eigen::Vector2d::Zero(), 1.28, 0.02);
  const Minimum best = searchUniformly(cost, Eigen::Vector2d::Zero(), 1.28, 0.02);
  EXPECT_EQ(found.evaluations, 176U);
  EXPECT_EQ(best.evaluations, 16384U);
  EXPECT_LT((found.position - least).cwiseAbs().maxCoeff(), 0.0101);
  EXPECT_NEAR(found.cost, best.cost, 1e-9);
}

TEST(DistanceField, IsTheDistanceOfTheNearestPoint) {
  std::vector<SurfacePoint> points(2);
  points[0].position = {1.0, 0.0};
  points[1].position = {-2.0, 3.0};
  DistanceField field;
  field.draw(points, 1.0);
  const auto at = [&](double x, double y) {
    return field.cost({{0.0, 0.0}}, Eigen::Vector2d(x, y), 1.0);
  };
  EXPECT_NEAR(at(1.3, 0.4), 0.5, DistanceField::kCell);
  EXPECT_NEAR(at(-2.0, 3.2), 0.2, DistanceField::kCell);
  EXPECT_DOUBLE_EQ(at(5.0, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(at(100.0, 0.0), 1.0);
  EXPECT_NEAR(field.cost({{0.0, 0.0}}, Eigen::Vector2d(1.3, 0.4), 1.0, 0.3), 0.2,
              DistanceField::kCell);
}

TEST(AngleHistogram, OfAWallHasOnePeakAtItsDirection) {
  std::vector<SurfacePoint> points(50);
  const double direction = 0.7;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double along = 0.05 * static_cast<double>(i);
    points[i].position = {along * std::cos(direction), along * std::sin(direction) + 1.0};
  }
  const auto histogram = angleHistogram(points, 10, 360);
  const auto peak = std::max_element(histogram.begin(), histogram.end()) - histogram.begin();
  const double angle = (static_cast<double>(peak) + 0.5) * geometry::kPi / 360.0;
  EXPECT_NEAR(angle - 0.5 * geometry::kPi, direction, geometry::kPi / 360.0);
}

// Eq. 4.7, written out.
TEST(AngleHistogram, CandidatesAreTheMaximaOfTheCorrelation) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> h0(36);
  for (double& value : h0) value = unit(random);
  constexpr std::size_t kTurn = 5;
  std::vector<double> h1(h0.size());
  for (std::size_t i = 0; i < h0.size(); ++i) h1[i] = h0[(i + kTurn) % h0.size()];
  double best = 0.0;
  for (std::size_t i = 0; i < h0.size(); ++i) best += h0[i] * h0[i];
  const auto candidates = correlateHistograms(h0, h1, 0.0, 0.6);
  ASSERT_FALSE(candidates.empty());
  const double bin = geometry::kPi / 36.0;
  EXPECT_NEAR(candidates.front().heading, kTurn * bin, 0.5 * bin);
  EXPECT_NEAR(candidates.front().correlation, best, 1e-9);
  for (const HeadingCandidate& candidate : candidates) {
    EXPECT_LE(std::abs(candidate.heading), 0.6 + bin);
    EXPECT_LE(candidate.correlation, best + 1e-9);
  }
}

TEST(AngleHistogram, FindsTheTurnOfAScan) {
  Viewer viewer(test::furnishedRoom(), test::scanner(), 2);
  const SurfaceScan reference = surfacesFrom(viewer, {0.0, 0.0, 0.0});
  for (const double turn : {-0.5, -0.1, 0.2, 0.6}) {
    const SurfaceScan turned = surfacesFrom(viewer, {0.1, 0.0, turn});
    const auto candidates = correlateHistograms(angleHistogram(reference.points, 20, 360),
                                                angleHistogram(turned.points, 20, 360), 0.0, 0.7);
    ASSERT_FALSE(candidates.empty());
    EXPECT_NEAR(candidates.front().heading, turn, geometry::radians(1.5));
  }
}

TEST(SortedPoints, FindTheNearestNeighbour) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<SurfacePoint> points(200);
  for (SurfacePoint& point : points) point.position = {unit(random), unit(random)};
  const SortedPoints sorted(points);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d query(unit(random), unit(random));
    double least = std::numeric_limits<double>::infinity();
    for (const SurfacePoint& point : points) {
      least = std::min(least, (point.position - query).norm());
    }
    const Eigen::Vector2d* nearest = sorted.nearest(query, 0.1);
    EXPECT_EQ(nearest != nullptr, least <= 0.1);
    EXPECT_EQ(sorted.hasNear(query, 0.1), least <= 0.1);
    if (nearest == nullptr) continue;
    EXPECT_DOUBLE_EQ((*nearest - query).norm(), least);
  }
}

TEST(PoseSpace, CorrelationFindsTheMotion) {
  Viewer viewer(test::furnishedRoom(), test::scanner(), 6);
  const SurfaceScan reference = surfacesFrom(viewer, {0.0, 0.0, 0.0});
  const Pose2 motion(0.21, -0.13, 0.22);
  const SurfaceScan surfaces = surfacesFrom(viewer, motion);
  const PoseSpaceConfig config;
  const Correlation found =
      correlatePoses(surfaces.points, SortedPoints(reference.points), {Pose2(), 0.4, 0.5}, config);
  const Pose2 error = geometry::between(motion, found.T_reference_base);
  EXPECT_LT(error.translation().norm(), config.step);
  EXPECT_LT(std::abs(error.theta()), 2.0 * config.angle_step);
  EXPECT_GT(found.count, surfaces.points.size() / 2);
}

TEST(CorrelativeSearch, FindsAScanAnywhereInItsWindow) {
  Viewer viewer(test::furnishedRoom(), test::scanner(), 8);
  Submap submap;
  submap.add({}, surfacesFrom(viewer, {}), 10);
  const SearchRasters rasters(submap, Eigen::Vector2d::Zero());
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    const Pose2 pose(0.8 * unit(random), 0.8 * unit(random), 0.9 * unit(random));
    const auto found = searchRasters(surfacesFrom(viewer, pose).points, rasters,
                                     {Pose2(), 0.8, 0.9}, {0.4, 0.4, 0.45}, 5);
    bool near = false;
    for (const SearchCandidate& candidate : found.candidates) {
      const Pose2 error = geometry::between(pose, candidate.T_odom_base);
      near = near || (error.translation().norm() < 0.2 && std::abs(error.theta()) < 0.06);
    }
    EXPECT_TRUE(near) << i;
  }
}

TEST(RangeProfile, KnowsWhatAScanSaw) {
  Viewer viewer(test::squareRoom(), test::scanner(), 1);
  const RangeProfile profile(surfacesFrom(viewer, {}));
  EXPECT_EQ(profile.at({1.0, 0.0}), Sight::kFree);
  EXPECT_EQ(profile.at({2.0, 0.3}), Sight::kSurface);
  EXPECT_EQ(profile.at({3.0, 0.0}), Sight::kHidden);
  EXPECT_EQ(profile.at({-1.0, 0.1}), Sight::kUnknown);
}

TEST(SurfacePoints, WallsHaveNormalsTowardsTheSensorUpToTheCorners) {
  Viewer viewer(test::squareRoom(), test::scanner(), 1);
  const SurfaceScan surfaces = surfacesFrom(viewer, {});
  std::size_t straight = 0;
  for (const SurfacePoint& point : surfaces.points) {
    if (!point.hasNormal()) continue;
    EXPECT_LT(point.normal.dot(point.position), 0.0);
    // Every wall is level or upright.
    const double off = point.normal.cwiseAbs().minCoeff();
    if (off < 0.2) ++straight;
  }
  EXPECT_GT(straight, surfaces.points.size() * 95 / 100);
}

TEST(SurfacePoints, NormalsErrAsTheySay) {
  double squares = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Viewer viewer(test::plainCorridor(), test::scanner(361, geometry::kPi, 8.0), seed);
    for (const SurfacePoint& point : surfacesFrom(viewer, {}).points) {
      if (!point.hasNormal()) continue;
      const double error = std::atan2(point.normal.x(), std::abs(point.normal.y()));
      squares += error * error / point.normal_variance;
      count += 1.0;
    }
  }
  EXPECT_GT(squares / count, 0.5);
  EXPECT_LT(squares / count, 2.0);
}

}  // namespace
}  // namespace sightline::dead_reckoning
