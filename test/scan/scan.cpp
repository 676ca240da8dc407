#include "sightline/scan/scan.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "monte_carlo.h"

namespace sightline::scan {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using geometry::Pose2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::shared_ptr<const ScanGeometry> limited(double range_min, double range_max) {
  return ScanGeometry::uniform(0.0, 0.1, 3, 0.0, range_min, range_max);
}

TEST(Classify, FollowsRep117) {
  const auto geometry = limited(0.1, 30.0);
  EXPECT_EQ(classify(5.0, *geometry), ReturnKind::kValid);
  EXPECT_EQ(classify(-kInfinity, *geometry), ReturnKind::kTooNear);
  EXPECT_EQ(classify(kInfinity, *geometry), ReturnKind::kNothing);
  EXPECT_EQ(classify(std::numeric_limits<double>::quiet_NaN(), *geometry), ReturnKind::kInvalid);
}

TEST(Classify, TakesTheLimitsThemselvesAsValid) {
  const auto geometry = limited(0.1, 30.0);
  EXPECT_EQ(classify(0.1, *geometry), ReturnKind::kValid);
  EXPECT_EQ(classify(30.0, *geometry), ReturnKind::kValid);
  EXPECT_EQ(classify(std::nextafter(0.1, 0.0), *geometry), ReturnKind::kTooNear);
  EXPECT_EQ(classify(std::nextafter(30.0, 31.0), *geometry), ReturnKind::kNothing);
}

TEST(Classify, MakesNothingOfZeroAndNegativeRanges) {
  for (const double range_min : {0.0, 0.1}) {
    const auto geometry = limited(range_min, 30.0);
    EXPECT_EQ(classify(0.0, *geometry), ReturnKind::kInvalid);
    EXPECT_EQ(classify(-0.0, *geometry), ReturnKind::kInvalid);
    EXPECT_EQ(classify(-1.0, *geometry), ReturnKind::kInvalid);
  }
}

TEST(Classify, NeverTakesAnInfiniteRangeAsMeasured) {
  EXPECT_EQ(classify(kInfinity, *limited(0.0, kInfinity)), ReturnKind::kNothing);
  EXPECT_EQ(classify(1e300, *limited(0.0, kInfinity)), ReturnKind::kValid);
}

Scan threeBeams() {
  Scan scan(ScanGeometry::uniform(-0.5, 0.5, 3, 0.01, 0.1, 30.0), 0, {2.0, 3.0, 4.0});
  scan.setRangeVariances({1e-4, 2e-4, 3e-4});
  scan.angular_variance = 1e-5;
  return scan;
}

TEST(Scan, PointsLieAlongTheirBeams) {
  const Scan scan = threeBeams();
  EXPECT_EQ(scan.beams(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = scan.geometry()->angles()[i];
    const Vector2d expected = scan.ranges()[i] * Vector2d(std::cos(angle), std::sin(angle));
    EXPECT_LT((scan.point(i) - expected).norm(), 1e-15);
    EXPECT_LT((scan.direction(i) - expected.normalized()).norm(), 1e-15);
  }
}

TEST(Scan, MotionCarriesPointsAndDirectionsAlong) {
  Scan scan = threeBeams();
  const Scan still = scan;
  scan.setSensorMotion({Pose2(), Pose2(0.1, 0.2, 0.3), Pose2(0.3, 0.3, 0.5)});
  for (std::size_t i = 0; i < 3; ++i) {
    const Pose2& T_start_beam = scan.sensorMotion()[i];
    EXPECT_LT((scan.point(i) - T_start_beam * still.point(i)).norm(), 1e-15);
    EXPECT_LT((scan.direction(i) - T_start_beam.rotation() * still.direction(i)).norm(), 1e-15);
  }
}

class ScanNoise : public testing::TestWithParam<bool> {};

TEST_P(ScanNoise, PointCovarianceMatchesMonteCarlo) {
  Scan scan = threeBeams();
  scan.transverse_variance = 2e-4;
  if (GetParam()) scan.setSensorMotion(std::vector<Pose2>(3, Pose2(0.5, -0.5, 1.1)));
  const double angle = scan.geometry()->angles()[2];
  test::Gauss gauss(1);
  test::Moments<2> moments;
  for (int i = 0; i < 40000; ++i) {
    const double range = scan.ranges()[2] + gauss(std::sqrt(scan.rangeVariances()[2]));
    const double turned = angle + gauss(std::sqrt(scan.angular_variance));
    Vector2d point = range * Vector2d(std::cos(turned), std::sin(turned));
    point += gauss(std::sqrt(2e-4)) * Vector2d(-std::sin(angle), std::cos(angle));
    moments.add(GetParam() ? scan.sensorMotion()[2] * point : point);
  }
  EXPECT_LT(test::relativeError(moments.covariance(), scan.covariance(2)), 0.03);
  EXPECT_LT((moments.mean() - scan.point(2)).norm(), 3e-4);
}

INSTANTIATE_TEST_SUITE_P(StillAndMoving, ScanNoise, testing::Bool());

TEST(Scan, RangeNoiseAloneLiesAlongTheBeam) {
  Scan scan = threeBeams();
  scan.angular_variance = 0.0;
  const Vector2d along = scan.direction(0);
  const Matrix2d expected = 1e-4 * along * along.transpose();
  EXPECT_LT((scan.covariance(0) - expected).norm(), 1e-18);
}

TEST(Scan, HoldsOneEntryABeamAlways) {
  const auto three = ScanGeometry::uniform(-0.5, 0.5, 3, 0.01, 0.1, 30.0);
  EXPECT_THROW(Scan(three, 0, {1.0, 2.0}), InvalidScan);
  EXPECT_THROW(Scan(three, 0, {1.0, 2.0, 3.0}, {1.0}), InvalidScan);
  EXPECT_THROW(Scan(nullptr, 0, {}), InvalidScan);
  Scan scan = threeBeams();
  EXPECT_THROW(scan.setRangeVariances({1.0}), InvalidScan);
  EXPECT_THROW(scan.setSensorMotion({Pose2()}), InvalidScan);
  EXPECT_THROW(scan.setIntensities({1.0, 2.0}), InvalidScan);
  EXPECT_EQ(scan.rangeVariances().size(), 3U) << "what was refused left nothing behind";
  EXPECT_TRUE(scan.sensorMotion().empty());
}

TEST(Scan, KindsFollowFromTheRanges) {
  Scan scan = threeBeams();
  scan.setRange(1, kInfinity);
  EXPECT_EQ(scan.kinds()[1], ReturnKind::kNothing);
  scan.setRange(1, 2.5);
  EXPECT_TRUE(scan.isValid(1));
  EXPECT_EQ(scan.ranges()[1], 2.5);
}

// A point and its covariance of a sensor upside down, mirrored at the x axis.
TEST(Scan, MirroredIsWhatASensorTheRightWayUpSees) {
  Scan scan = threeBeams();
  scan.setSensorMotion({Pose2(), Pose2(0.1, 0.2, 0.3), Pose2(0.3, 0.3, 0.5)});
  scan.setKind(1, ReturnKind::kInvalid);
  scan.motion_noise.drift << 1.0, 0.2, 0.3, 0.2, 2.0, 0.4, 0.3, 0.4, 3.0;
  scan.motion_noise.jitter_axis = {0.1, 0.2};
  const Scan upright = mirrored(scan, scan.geometry()->mirrored());
  const Matrix2d flip = Vector2d(1.0, -1.0).asDiagonal();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((upright.point(i) - flip * scan.point(i)).norm(), 1e-15);
    EXPECT_LT((upright.covariance(i) - flip * scan.covariance(i) * flip).norm(), 1e-15);
    EXPECT_EQ(upright.kinds()[i], scan.kinds()[i]);
  }
  EXPECT_DOUBLE_EQ(upright.motion_noise.drift(0, 1), -0.2);
  EXPECT_DOUBLE_EQ(upright.motion_noise.drift(1, 2), 0.4);
  EXPECT_DOUBLE_EQ(upright.motion_noise.jitter_axis.y(), -0.2);
}

}  // namespace
}  // namespace sightline::scan
