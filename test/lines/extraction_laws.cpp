#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "lines/room_scan.h"
#include "sightline/lines/line_extractor.h"

namespace sightline::lines {
namespace {

using geometry::PolarLine;
using geometry::Pose2;
using test::Gauss;
using test::ScanOf;

ScanOf singleWall(double from, double to, double distance) {
  ScanOf scan;
  scan.walls = {{{to, distance}, {from, distance}}};
  return scan;
}

// Mean NEES and share inside the 95 % gate of the lines of a wall seen many times.
void expectHonestLines(const ScanOf& scene, unsigned seed) {
  Gauss gauss(seed);
  LineExtractor extractor;
  const PolarLine truth = geometry::transform(scene.pose.inverse(), scene.walls[0].line());
  double sum = 0.0;
  double inside = 0.0;
  constexpr int kScans = 1000;
  for (int i = 0; i < kScans; ++i) {
    const auto& segments = extractor.extract(scene.take(gauss));
    ASSERT_EQ(segments.size(), 1U);
    const double nees = test::normalisedSquare<2>(geometry::difference(segments[0].line, truth),
                                                  segments[0].line.covariance);
    sum += nees;
    inside += nees <= 5.991 ? 1.0 : 0.0;
  }
  EXPECT_NEAR(sum / kScans, 2.0, 0.3);
  EXPECT_GT(inside / kScans, 0.92);
}

TEST(LineCovariance, HoldsForAWallAhead) {
  expectHonestLines(singleWall(-1.5, 1.5, 2.0), 3);
}
TEST(LineCovariance, HoldsForAWallSeenObliquely) {
  expectHonestLines(singleWall(2.0, 5.0, 1.5), 4);
}

TEST(LineCovariance, HoldsForAMovingSensor) {
  ScanOf scene = singleWall(-1.5, 1.5, 2.0);
  scene.motion = {0.04, 0.0, 0.08};
  expectHonestLines(scene, 5);
}

TEST(Extraction, AMotionOfTheSceneMovesTheLines) {
  const Pose2 T(0.3, -0.2, 0.4);
  ScanOf here = singleWall(-1.5, 1.5, 2.0);
  here.noise = 0.0;
  ScanOf there = here;
  there.pose = T;
  Gauss gauss(1);
  LineExtractor first;
  LineExtractor second;
  const auto& before = first.extract(here.take(gauss));
  const auto& after = second.extract(there.take(gauss));
  ASSERT_EQ(before.size(), 1U);
  ASSERT_EQ(after.size(), 1U);
  const PolarLine moved = geometry::transform(T.inverse(), before[0].line);
  EXPECT_LT(geometry::difference(after[0].line, moved).norm(), 1e-4);
}

TEST(Extraction, ReversedBeamsGiveTheSameLines) {
  ScanOf forward = singleWall(-1.5, 1.5, 2.0);
  forward.noise = 0.0;
  ScanOf backward = forward;
  backward.angle_min = -forward.angle_min;
  backward.angle_increment = -forward.angle_increment;
  Gauss gauss(1);
  LineExtractor first;
  LineExtractor second;
  const auto& a = first.extract(forward.take(gauss));
  const auto& b = second.extract(backward.take(gauss));
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LT(geometry::difference(a[0].line, b[0].line).norm(), 1e-4);
}

TEST(Extraction, ScansWithoutReturnsHaveNoLines) {
  ScanOf scene = singleWall(-1.5, 1.5, 2.0);
  Gauss gauss(1);
  LineExtractor extractor;
  for (const double range :
       {std::numeric_limits<double>::quiet_NaN(), 0.0, -1.0,
        std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    scan::Scan scan = scene.take(gauss);
    std::fill(scan.ranges.begin(), scan.ranges.end(), range);
    scene.classify(scan);
    EXPECT_TRUE(extractor.extract(scan).empty()) << range;
  }
  scene.beams = 2;
  EXPECT_TRUE(extractor.extract(scene.take(gauss)).empty()) << "the number of beams may change";
}

}  // namespace
}  // namespace sightline::lines
