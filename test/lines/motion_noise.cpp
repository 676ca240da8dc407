#include <cmath>

#include <gtest/gtest.h>

#include "lines/motion_consistency.h"
#include "numeric_jacobian.h"
#include "sightline/lines/beam_motion.h"
#include "sightline/lines/beam_residuals.h"
#include "sightline/lines/line_extractor.h"
#include "sightline/lines/sweep_noise.h"

namespace sightline::lines {
namespace {

using test::NoisySweep;

void expectConsistent(const NoisySweep& noisy) {
  for (const test::WallPlace& wall : test::kWallPlaces) {
    const NoisySweep sweep = test::inFrontOf(wall, noisy);
    const test::MotionConsistency consistency = test::ConsistencyRun(sweep).of(3, 400);
    EXPECT_GT(consistency.found, 0.99) << wall.name;
    EXPECT_NEAR(consistency.nees, 2.0, 0.2) << wall.name;
    EXPECT_GE(consistency.inside, 0.93) << wall.name;
    EXPECT_LE(consistency.inside, 0.97) << wall.name;
    EXPECT_GT(consistency.nees_ignored, 2.2) << wall.name;
  }
}

TEST(MotionNoiseStatistics, HeadWithJitter) {
  expectConsistent(test::jitteringHead());
}

TEST(MotionNoiseStatistics, OdometryThatDrifts) {
  expectConsistent(test::wrongOdometry(true, false));
}

TEST(MotionNoiseStatistics, OdometryThatWalks) {
  expectConsistent(test::wrongOdometry(false, true));
}

TEST(MotionNoiseStatistics, FarMoreThanTheNoiseOfTheBeams) {
  NoisySweep sweep;
  sweep.motion = {0.2, 0.05, 0.4};
  sweep.noise.drift.diagonal().setConstant(2e-4);
  sweep.noise.walk.diagonal().setConstant(2e-4);
  expectConsistent(sweep);
}

// A wall that goes on behind a post stays one: its parts may have moved against each other.
TEST(MotionNoise, WallBehindAPostIsOne) {
  NoisySweep sweep = test::inFrontOf(test::kWallPlaces[2], test::wrongOdometry(true, true));
  sweep.noise.walk *= 9.0;
  sweep.scan.posts = {{{0.3, 3.0}, 0.05}};
  EXPECT_GT(test::ConsistencyRun(sweep).of(1, 300).found, 0.97);
}

TEST(MotionNoise, ArcMovesWithTheSensor) {
  NoisySweep sweep;
  sweep.scan = test::wallAhead(6.0, -1.0, 1.0);
  sweep.scan.walls.clear();
  sweep.scan.posts = {{{-1.0, 1.5}, 0.3}};
  sweep.motion = {0.1, 0.0, 0.3};
  sweep.noise.walk.diagonal() << 1e-4, 1e-4, 1e-4;
  test::Gauss gauss(5);
  LineExtractor extractor;
  test::Moments<1> nees;
  for (int i = 0; i < 500; ++i) {
    extractor.extract(sweep.take(gauss));
    if (extractor.arcs().size() != 1) continue;
    const geometry::Arc& arc = extractor.arcs()[0];
    const Eigen::Vector3d error(arc.centre.x() + 1.0, arc.centre.y() - 1.5, arc.radius - 0.3);
    nees.add(test::Moments<1>::Vector(test::normalisedSquare<3>(error, arc.covariance)));
  }
  EXPECT_GT(nees.count(), 490);
  EXPECT_NEAR(nees.mean()[0], 3.0, 0.4);
}

/// One wall in a scan, as the extractor's classes have it.
struct FittedWall {
  explicit FittedWall(const scan::Scan& of) : scan(of) {
    beams.assign(scan);
    noise.assign(scan, beams);
    piece.line = {0.0, 1.0, 2.0, {}};
    piece.end = beams.size;
    refine(beams, kWide, piece);
  }
  Eigen::Vector2d line() const {
    const geometry::PolarLine polar = piece.line.polar();
    return {polar.rho, polar.phi};
  }

  static constexpr double kWide = 1e6;
  scan::Scan scan;
  BeamArray beams;
  SweepNoise noise;
  Piece piece;
};

scan::Scan noiseless(const Eigen::Vector3d& motion, const scan::MotionNoise& noise) {
  test::ScanOf of = test::wallAhead(2.0, -1.0, 2.5);
  of.motion = motion;
  scan::Scan scan = of.takeWithoutNoise();
  scan.motion_noise = noise;
  return scan;
}

// A covariance of rank one is the square of what a drift along that axis does: the derivative of
// the fitted line by the motion over the sweep.
TEST(SweepNoise, JacobianOfTheMotionIsThatOfARefit) {
  const Eigen::Vector3d motion(0.1, 0.02, 0.2);
  const scan::Scan scan = noiseless(motion, {});
  const auto refit = [&](const Eigen::Vector3d& error) -> Eigen::Vector2d {
    scan::Scan moved = scan;
    std::vector<geometry::Pose2> poses = scan.sensorMotion();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i] =
          geometry::Pose2(Eigen::Vector3d(poses[i].coordinates() + timeRatio(scan, i) * error));
    }
    moved.setSensorMotion(std::move(poses));
    return FittedWall(moved).line();
  };
  const Eigen::Matrix<double, 2, 3> jacobian = test::numericJacobian<2, 3>(
      refit, Eigen::Vector3d(0, 0, 0),
      [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) -> Eigen::Vector2d { return a - b; },
      1e-3);
  for (int i = 0; i < 3; ++i) {
    scan::MotionNoise noise;
    noise.drift(i, i) = 1.0;
    FittedWall wall(noiseless(motion, noise));
    const Eigen::Matrix2d expected = jacobian.col(i) * jacobian.col(i).transpose();
    EXPECT_LT((wall.noise.ofLine(wall.piece, FittedWall::kWide) - expected).norm(),
              0.02 * expected.norm() + 1e-6)
        << i;
  }
}

// All pairs of beams, min(s, s') walk each.
TEST(MotionSum, WalkIsTheSumOverAllPairs) {
  scan::MotionNoise noise;
  noise.walk << 3.0, 0.5, 0.2, 0.5, 2.0, 0.1, 0.2, 0.1, 1.0;
  test::Gauss gauss(3);
  motion::MotionSum<2> sum;
  std::vector<std::pair<double, motion::MotionSum<2>::Response>> terms;
  for (int i = 0; i < 40; ++i) {
    motion::MotionSum<2>::Response response;
    for (int k = 0; k < 6; ++k) response(k % 2, k / 2) = gauss();
    terms.emplace_back(gauss.uniform(0.0, 1.0), response);
    sum.add(terms.back().first, response);
  }
  Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();
  for (const auto& [time, response] : terms) {
    for (const auto& [other_time, other] : terms) {
      expected += std::min(time, other_time) * response * noise.walk * other.transpose();
    }
  }
  EXPECT_LT((sum.covariance(noise) - expected).norm(), 1e-12 * expected.norm());
}

TEST(SweepNoise, DifferenceOfALineWithItselfHasNone) {
  scan::MotionNoise noise;
  noise.drift = noise.walk = Eigen::Matrix3d::Identity();
  FittedWall wall(noiseless({0.1, 0.0, 0.1}, noise));
  const Eigen::Matrix2d covariance =
      wall.noise.ofDifference(wall.piece, wall.piece, 0.5, FittedWall::kWide);
  EXPECT_LT(covariance.norm(), 1e-9);
}

// Displacement δ perp(p − axis), whatever the direction of the line it is seen across.
TEST(BeamArray, JitterTurnsTheEndPointsAboutItsAxis) {
  scan::MotionNoise noise;
  noise.jitter = 1e-4;
  noise.jitter_axis = {0.3, -0.2};
  scan::Scan scan = noiseless({0.05, 0.0, 0.1}, noise);
  scan.setRangeVariances(std::vector<double>(scan.beams(), 1e-4));
  BeamArray beams;
  beams.assign(scan);
  for (std::size_t i = 0; i < beams.size; i += 37) {
    const Eigen::Vector2d arm = scan.point(beams.beam[i]) - noise.jitter_axis;
    const Eigen::Vector2d moved(-arm.y(), arm.x());
    const Eigen::Matrix2d covariance =
        scan.covariance(beams.beam[i]) + 1e-4 * moved * moved.transpose();
    const LineEstimate line{std::cos(1.2), std::sin(1.2), 2.0, {}};
    const Eigen::Vector2d normal(line.normal_x, line.normal_y);
    if (normal.dot(scan.direction(beams.beam[i])) < 0.05) continue;
    const double variance = normal.dot(covariance * normal);
    EXPECT_NEAR(1.0 / static_cast<double>(residualsOf(beams, i, line).weight[0]), variance,
                1e-3 * variance);
  }
}

}  // namespace
}  // namespace sightline::lines
