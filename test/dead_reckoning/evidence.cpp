#include "sightline/dead_reckoning/evidence.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "dead_reckoning/simulated_scans.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;

/// A scan of the furnished room as reference, and what speaks for poses of another.
class EvidenceInRoom : public testing::Test {
 protected:
  EvidenceInRoom() { submap_.add({}, look({}), 20); }

  SurfaceScan look(const Pose2& pose) {
    return readSurfaces(viewer_.look(pose, 0.0), Pose2(), Eigen::Vector3d::Zero());
  }

  Evidence at(const SurfaceScan& surfaces, const Pose2& pose) const {
    constexpr double kRigid = 1e-12;  // the pose stays where it is put
    const geometry::UncertainPose2 fixed{pose, kRigid * Eigen::Matrix3d::Identity()};
    const LineMatch match = LineMatcher(0.01).match(surfaces, submap_, pose, fixed, 0.05);
    return weigh(match, surfaces, RangeProfile(surfaces), submap_);
  }

  test::Viewer viewer_{test::furnishedRoom(), test::scanner(), 3};
  Submap submap_;
};

TEST_F(EvidenceInRoom, TheTrueExplainsNearlyAll) {
  const Pose2 pose(0.1, 0.05, 0.05);
  const Evidence evidence = at(look(pose), pose);
  EXPECT_GT(evidence.inliers, 0.9);
  EXPECT_LT(evidence.contradictions, 0.05);
  EXPECT_LT(evidence.cost, 0.1);
}

TEST_F(EvidenceInRoom, AWrongPoseIsContradicted) {
  const SurfaceScan surfaces = look({});
  const Evidence evidence = at(surfaces, {1.0, 0.5, 0.6});
  EXPECT_LT(evidence.inliers, 0.4);
  EXPECT_GT(evidence.contradictions, 0.3);
  EXPECT_GT(evidence.cost, 0.4);
  EXPECT_GT(evidence.cost, at(surfaces, {}).cost + 0.3);
}

// A point where the reference did not see says neither.
TEST_F(EvidenceInRoom, WhatIsNewDoesNotContradict) {
  const Pose2 back(0.0, 0.0, geometry::kPi);
  const Evidence evidence = at(look(back), back);
  EXPECT_LT(evidence.contradictions, 0.05);
  EXPECT_NEAR(evidence.cost, 0.5, 0.1);
}

TEST_F(EvidenceInRoom, AScanWithoutPointsExplainsNothing) {
  const Evidence evidence = at(SurfaceScan(), {});
  EXPECT_EQ(evidence.inliers, 0.0);
  EXPECT_TRUE(std::isfinite(evidence.cost));
}

LineMatch matchWith(const std::vector<double>& residuals) {
  LineMatch match;
  match.residuals = residuals;
  return match;
}

TEST(ResidualStatistics, OfIndependentResiduals) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, 1.2);
  std::vector<double> residuals(20000);
  for (double& residual : residuals) residual = normal(random);
  const ResidualStatistics statistics = residualStatistics(matchWith(residuals));
  // A few beyond four standard deviations are left out.
  EXPECT_NEAR(statistics.variance, 1.44, 0.05);
  EXPECT_NEAR(statistics.correlation, 0.0, 0.03);
}

TEST(ResidualStatistics, OfNeighboursThatShareTheirErrors) {
  constexpr double kCorrelation = 0.6;
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal(0.0, std::sqrt(1.0 - kCorrelation * kCorrelation));
  std::vector<double> residuals(20000);
  double before = 0.0;
  for (double& residual : residuals) residual = before = kCorrelation * before + normal(random);
  const ResidualStatistics statistics = residualStatistics(matchWith(residuals));
  EXPECT_NEAR(statistics.correlation, kCorrelation, 0.03);
  // The mean of n of them varies as that of n (1 - r)/(1 + r) independent ones.
  EXPECT_NEAR(statistics.factor(), 4.0, 0.4);
  EXPECT_NEAR(statistics.common(), 0.75, 0.03);
}

TEST(ResidualStatistics, OfHardlyAnyResidualsAreWhatWasExpected) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const auto& residuals : {std::vector<double>{},
                                {none, none, 1.0, none},
                                {100.0, 200.0},
                                {0.0, 0.0, 0.0, 0.0, 0.0}}) {
    const ResidualStatistics statistics = residualStatistics(matchWith(residuals));
    EXPECT_EQ(statistics.variance, 1.0);
    EXPECT_EQ(statistics.correlation, 0.0);
  }
}

}  // namespace
}  // namespace sightline::dead_reckoning
