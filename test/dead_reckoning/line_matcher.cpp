#include "sightline/dead_reckoning/line_matcher.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "dead_reckoning/simulated_scans.h"
#include "sightline/dead_reckoning/evidence.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;

TEST(LineResidual, JacobianIsTheNumericDifference) {
  const Surfel surfel{{2.0, 1.0}, {-0.6, 0.8}, 0.0, 0.05};
  const Eigen::Vector2d point(1.3, -0.4);
  const Pose2 pose(0.2, 0.5, 0.7);
  const auto at = [&](const Pose2& T_odom_base) {
    return lineResidual(T_odom_base.translation(), T_odom_base.rotation() * point, surfel);
  };
  EXPECT_NEAR(at(pose).value, surfel.normal.dot(pose * point - surfel.position), 1e-12);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
    const double ahead = at(Pose2(pose.coordinates() + step)).value;
    const double back = at(Pose2(pose.coordinates() - step)).value;
    EXPECT_NEAR((ahead - back) / (2.0 * kStep), at(pose).jacobian[i], 1e-8);
  }
}

geometry::UncertainPose2 unknown() {
  return {{}, 100.0 * Eigen::Matrix3d::Identity()};
}

SurfaceScan lookFrom(test::Viewer& viewer, const Pose2& pose) {
  return readSurfaces(viewer.look(pose, 0.0), Pose2(), Eigen::Vector3d::Zero());
}

TEST(LineMatcher, FindsThePoseFromNearby) {
  test::Viewer viewer(test::furnishedRoom(), test::scanner(), 4);
  Submap submap;
  submap.add({}, lookFrom(viewer, {}), 20);
  const Pose2 pose(0.12, -0.08, 0.09);
  const SurfaceScan surfaces = lookFrom(viewer, pose);
  const LineMatch match = LineMatcher(0.01).match(surfaces, submap, {}, unknown(), 0.2);
  const Pose2 error = geometry::between(pose, match.T_odom_base);
  EXPECT_LT(error.translation().norm(), 0.01);
  EXPECT_LT(std::abs(error.theta()), 0.005);
  EXPECT_EQ(match.residuals.size(), surfaces.points.size());
  EXPECT_EQ(match.distances.size(), surfaces.points.size());
  EXPECT_TRUE(match.motion_gradient.isZero(0.0));
}

/// The mean of many scans from one place: its errors count little.
SurfaceScan averageLook(test::Viewer& viewer) {
  constexpr int kLooks = 100;
  scan::Scan scan = viewer.look({}, 0.0);
  std::vector<double> sums = scan.ranges();
  for (int i = 1; i < kLooks; ++i) {
    const std::vector<double> ranges = viewer.look({}, 0.0).ranges();
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += ranges[k];
  }
  for (std::size_t k = 0; k < sums.size(); ++k) scan.setRange(k, sums[k] / kLooks);
  return readSurfaces(scan, Pose2(), Eigen::Vector3d::Zero());
}

TEST(LineMatcher, WithItsResidualsTheInformationIsThatOfTheErrors) {
  constexpr int kRuns = 300;
  test::Viewer viewer(test::furnishedRoom(), test::scanner(), 5);
  Submap submap;
  submap.add({}, averageLook(viewer), 20);
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const LineMatch match =
        LineMatcher(0.01).match(lookFrom(viewer, {}), submap, {}, unknown(), 0.05);
    const Eigen::Vector3d error = match.T_odom_base.coordinates();
    nees += error.dot(match.information * error) / residualStatistics(match).factor() / kRuns;
  }
  EXPECT_GT(nees, 2.5);
  EXPECT_LT(nees, 3.5);
}

TEST(LineMatcher, APlainCorridorSaysNothingOfTheWayAlongIt) {
  test::Viewer viewer(test::plainCorridor(), test::scanner(361, geometry::kPi, 8.0), 3);
  Submap submap;
  submap.add({}, lookFrom(viewer, {}), 20);
  const geometry::UncertainPose2 prior{{0.1, 0.0, 0.0}, 0.01 * Eigen::Matrix3d::Identity()};
  const LineMatch match =
      LineMatcher(0.01).match(lookFrom(viewer, {}), submap, prior.mean, prior, 0.2);
  EXPECT_LT(match.information(0, 0), 1e-2 * match.information(1, 1));
  EXPECT_NEAR(match.T_odom_base.x(), 0.1, 0.02);
  EXPECT_NEAR(match.T_odom_base.y(), 0.0, 0.01);
}

TEST(LineMatcher, WithoutCounterpartsThePriorStands) {
  test::Viewer viewer(test::furnishedRoom(), test::scanner(), 4);
  Submap submap;
  submap.add({100.0, 0.0, 0.0}, lookFrom(viewer, {}), 20);
  const geometry::UncertainPose2 prior{{0.2, 0.1, 0.0}, 0.01 * Eigen::Matrix3d::Identity()};
  const LineMatch match =
      LineMatcher(0.01).match(lookFrom(viewer, {}), submap, prior.mean, prior, 0.2);
  EXPECT_LT((match.T_odom_base.coordinates() - prior.mean.coordinates()).norm(), 1e-9);
  EXPECT_LT(match.information.cwiseAbs().maxCoeff(), 1e-9);
  for (const double residual : match.residuals) EXPECT_TRUE(std::isnan(residual));
}

}  // namespace
}  // namespace sightline::dead_reckoning
