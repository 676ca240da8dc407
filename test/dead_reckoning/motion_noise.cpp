#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "dead_reckoning/simulated_scans.h"
#include "monte_carlo.h"
#include "sightline/dead_reckoning/dead_reckoner.h"
#include "sightline/dead_reckoning/line_matcher.h"
#include "sightline/dead_reckoning/motion_gradient.h"
#include "sightline/geometry/statistics.h"
#include "sightline/logs/nees.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;

constexpr double kScanPeriod = 0.2;  // s

std::shared_ptr<const scan::ScanGeometry> slowScanner() {
  constexpr double kDuration = 0.18;  // s
  return scan::ScanGeometry::uniform(-0.5 * geometry::kPi, geometry::kPi / 360.0, 361,
                                     kDuration / 360.0, 0.05, 20.0);
}

/// The sensor's motion within a sweep as somebody reports it who errs as the noise says.
std::vector<Pose2> reported(const scan::ScanGeometry& geometry, const Eigen::Vector3d& twist,
                            const scan::MotionNoise& noise, test::Gauss& gauss) {
  const Eigen::Vector3d drift = gauss(noise.drift);
  Eigen::Vector3d walk = Eigen::Vector3d::Zero();
  std::vector<Pose2> motion;
  double before = 0.0;
  for (const double offset : geometry.timeOffsets()) {
    const double share = offset / geometry.timeOffsets().back();
    walk += gauss(Eigen::Matrix3d((share - before) * noise.walk));
    before = share;
    motion.emplace_back(Pose2::exp(offset * twist).coordinates() + share * drift + walk);
  }
  return motion;
}

// The sum that a gradient errs by, drawn and summed up.
TEST(MotionGradient, CovarianceIsThatOfTheSum) {
  test::Viewer viewer(test::furnishedRoom(), slowScanner(), 1);
  const Eigen::Vector3d twist(0.4, 0.1, 0.8);
  const Pose2 T_base_sensor(0.2, -0.1, 0.7);
  const Pose2 T_odom_base(1.0, 0.5, -0.4);
  scan::Scan scan = viewer.look({}, 0.0, twist);
  test::Gauss gauss(2);
  scan.setSensorMotion(reported(*scan.geometry(), twist, {}, gauss));
  scan.motion_noise.drift = Eigen::Vector3d(1e-4, 4e-4, 1e-5).asDiagonal();
  scan.motion_noise.walk = Eigen::Vector3d(2e-4, 1e-4, 3e-5).asDiagonal();
  const SurfaceScan surfaces = readSurfaces(scan, T_base_sensor, Eigen::Vector3d::Zero());
  const Eigen::Matrix3d expected = surfaceMotionGradient(surfaces, T_odom_base, 1.0);
  test::Moments<3> sums;
  for (int run = 0; run < 2000; ++run) {
    scan::Scan wrong = scan;
    std::vector<Pose2> motion = reported(*scan.geometry(), twist, scan.motion_noise, gauss);
    wrong.setSensorMotion(motion);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t i = 0;
    for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
      if (!scan.isValid(beam)) continue;
      const SurfacePoint& point = surfaces.points[i++];
      if (!point.hasNormal()) continue;
      const Surfel surfel{T_odom_base * point.position, T_odom_base.rotation() * point.normal, 0.0,
                          0.0};
      const Eigen::Vector2d displaced = T_base_sensor * wrong.point(beam);
      const LineResidual residual =
          lineResidual(T_odom_base.translation(), T_odom_base.rotation() * displaced, surfel);
      const LineResidual right =
          lineResidual(T_odom_base.translation(), T_odom_base.rotation() * point.position, surfel);
      sum += residual.value * right.jacobian;
    }
    sums.add(sum);
  }
  EXPECT_LT(test::relativeError<3>(sums.covariance(), expected), 0.1);
}

TEST(MotionGradient, IsZeroWhereTheMotionIsKnown) {
  test::Viewer viewer(test::furnishedRoom(), slowScanner(), 1);
  const SurfaceScan surfaces = readSurfaces(viewer.look({}, 0.0), Pose2(), Eigen::Vector3d::Zero());
  EXPECT_TRUE(surfaces.sightings.empty());
  EXPECT_TRUE(surfaceMotionGradient(surfaces, {}, 0.01).isZero(0.0));
  EXPECT_TRUE(motionDisplacement(surfaces, {}).isZero(0.0));
}

// A drift that is the same for all beams moves the pose by as much.
TEST(MotionGradient, OfASweepWhoseBeamsAreAllLateIsTheMotionItself) {
  test::Viewer viewer(test::furnishedRoom(), slowScanner(), 1);
  scan::Scan scan = viewer.look({}, 0.0);
  scan.motion_noise.drift = Eigen::Vector3d(1e-4, 4e-4, 1e-5).asDiagonal();
  SurfaceScan surfaces = readSurfaces(scan, Pose2(), Eigen::Vector3d::Zero());
  for (Sighting& sighting : surfaces.sightings) sighting.time = 1.0;
  EXPECT_LT(test::relativeError<3>(motionDisplacement(surfaces, {}), scan.motion_noise.drift),
            0.05);
}

TEST(MotionNoise, JitterIsInTheVarianceOfWhatDoesNotFaceTheAxis) {
  const auto geometry = slowScanner();
  test::Viewer viewer(test::plainCorridor(), geometry, 1);
  scan::Scan scan = viewer.look({}, 0.0);
  const SurfaceScan still = readSurfaces(scan, Pose2(), Eigen::Vector3d::Zero());
  constexpr double kJitter = 1e-4;  // rad²
  scan.motion_noise.jitter = kJitter;
  scan.motion_noise.jitter_axis = {0.1, 0.0};
  const Pose2 T_base_sensor(0.5, 0.2, 0.0);
  const SurfaceScan jittery = readSurfaces(scan, T_base_sensor, Eigen::Vector3d::Zero());
  ASSERT_EQ(jittery.points.size(), still.points.size());
  for (std::size_t i = 0; i < still.points.size(); ++i) {
    if (!jittery.points[i].hasNormal()) continue;
    const Eigen::Vector2d arm = jittery.points[i].position - Eigen::Vector2d(0.6, 0.2);
    const double lever = jittery.points[i].normal.dot(Eigen::Vector2d(-arm.y(), arm.x()));
    EXPECT_NEAR(jittery.points[i].variance - still.points[i].variance, kJitter * lever * lever,
                1e-12);
  }
}

struct Score {
  double nees = 0.0;    // mean
  double inside = 0.0;  // share within the 95 % gate
};

/// Steps of a scanner that drives and turns while its sweeps last, by what it reports of that.
Score scoreOf(const scan::MotionNoise& noise, bool is_told, int runs) {
  constexpr int kRunSteps = 10;
  const Eigen::Vector3d twist(0.6, 0.1, 1.2);
  const auto at = [&](int i) {
    return Pose2(-1.5, 0.3, 0.0) * Pose2::exp(kScanPeriod * i * twist);
  };
  Score score;
  for (int run = 0; run < runs; ++run) {
    test::Gauss gauss(1000U + static_cast<unsigned>(run));
    test::Viewer viewer(test::furnishedRoom(), slowScanner(), static_cast<std::uint64_t>(run));
    DeadReckoner reckoner({});
    for (int i = 0; i <= kRunSteps; ++i) {
      scan::Scan scan = viewer.look(at(i), kScanPeriod * i, twist);
      scan.setSensorMotion(reported(*scan.geometry(), twist, noise, gauss));
      if (is_told) scan.motion_noise = noise;
      const auto update = reckoner.update(scan, Pose2());
      if (i == 0) continue;
      const double nees = logs::nees(update->step, geometry::between(at(i - 1), at(i)));
      score.nees += nees / (runs * kRunSteps);
      if (nees < geometry::kChiSquare95Of3) score.inside += 1.0 / (runs * kRunSteps);
    }
  }
  return score;
}

TEST(MotionNoiseStatistics, StepsAreAsUncertainAsTheyErrWhereTheSweepsMotionHasTwoPercentOfNoise) {
  constexpr double kShare = 0.02;
  const Eigen::Vector3d twist(0.6, 0.1, 1.2);
  const Eigen::Vector3d whole =
      Pose2::exp(slowScanner()->timeOffsets().back() * twist).coordinates();
  scan::MotionNoise noise;
  noise.drift = (kShare * whole).cwiseAbs2().asDiagonal();
  noise.walk = noise.drift;
  constexpr int kRuns = 60;
  const Score told = scoreOf(noise, true, kRuns);
  const Score ignored = scoreOf(noise, false, kRuns);
  std::printf("NEES %.2f, %.1f %% inside; with the noise ignored %.1f, %.1f %%\n", told.nees,
              100.0 * told.inside, ignored.nees, 100.0 * ignored.inside);
  EXPECT_GT(told.nees, 2.5);
  EXPECT_LT(told.nees, 3.5);
  EXPECT_GT(told.inside, 0.92);
  EXPECT_LT(told.inside, 0.98);
  EXPECT_GT(ignored.nees, 10.0);
}

}  // namespace
}  // namespace sightline::dead_reckoning
