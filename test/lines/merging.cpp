#include "sightline/lines/merging.h"

#include <gtest/gtest.h>

#include "lines/corner_scan.h"

namespace sightline::lines {
namespace {

using test::SmallScan;

TEST(Merging, DistanceIsInStandardDeviationsOfBoth) {
  const LineEstimate line{0.0, 1.0, 2.0, {1e4, 0.0, 1e3}};
  EXPECT_EQ(mahalanobisSquared(line, line, 0.3), 0.0);
  LineEstimate other = line;
  other.rho += 0.03;
  EXPECT_NEAR(mahalanobisSquared(line, other, 0.0), 0.03 * 0.03 / 2e-4, 1e-9);
  const Eigen::Matrix2d motion = Eigen::Vector2d(2e-4, 0.0).asDiagonal();
  EXPECT_NEAR(mahalanobisSquared(line, other, 0.0, motion), 0.03 * 0.03 / 4e-4, 1e-9);
}

TEST(Merging, PartsOfAWallBecomeOne) {
  SmallScan scan(test::wallAhead(2.0, -1.0, 2.0));
  Piece before = scan.piece(200, 300, test::kLineAhead);
  const Piece after = scan.piece(303, 400, test::kLineAhead);
  EXPECT_TRUE(Merging(scan.beams, scan.noise, scan.config).merge(before, after));
  EXPECT_EQ(before.first, scan.at(200));
  EXPECT_EQ(before.end, scan.at(400));
  EXPECT_DOUBLE_EQ(before.beams, 200.0);
  EXPECT_NEAR(before.line.rho, 2.0, 1e-5);
}

TEST(Merging, WallsBeyondTheGapLimitStayApart) {
  test::ScanOf of = test::wallAhead(2.0, -1.0, 2.0);
  of.walls = {{{0.53, 2.0}, {2.0, 2.0}}, {{-1.0, 2.0}, {0.177, 2.0}}};
  SmallScan scan(of);
  Piece before = scan.piece(200, 300, test::kLineAhead);
  const Piece after = scan.piece(340, 400, test::kLineAhead);  // 0.35 m on
  EXPECT_FALSE(Merging(scan.beams, scan.noise, scan.config).merge(before, after));
  EXPECT_EQ(before.end, scan.at(300));
  scan.config.max_gap = 0.4;
  EXPECT_TRUE(Merging(scan.beams, scan.noise, scan.config).merge(before, after));
}

TEST(Merging, AShallowPlaceBetweenIsNoGap) {
  for (const double depth : {0.02, 0.1}) {
    test::ScanOf of = test::wallAhead(2.0, 0.53, 2.0);
    of.walls.push_back({{0.177, 2.0 + depth}, {0.53, 2.0 + depth}});
    of.walls.push_back({{-1.0, 2.0}, {0.177, 2.0}});
    SmallScan scan(of);
    Piece before = scan.piece(200, 300, test::kLineAhead);
    const Piece after = scan.piece(341, 400, test::kLineAhead);
    EXPECT_EQ(Merging(scan.beams, scan.noise, scan.config).merge(before, after), depth < 0.05);
  }
}

TEST(Merging, StepOfAWallIsTwoWalls) {
  test::ScanOf of = test::wallAhead(2.0, 0.0, 2.0);
  of.walls.push_back({{-2.0, 2.05}, {0.0, 2.05}});
  SmallScan scan(of);
  Piece before = scan.piece(250, 358, test::kLineAhead);
  LineEstimate further = test::kLineAhead;
  further.rho = 2.05;
  const Piece after = scan.piece(362, 470, further);
  EXPECT_FALSE(Merging(scan.beams, scan.noise, scan.config).merge(before, after));
}

TEST(Merging, WallsOfACornerStayApart) {
  SmallScan scan = test::cornerScan();
  Piece before = scan.piece(250, 467, test::kLineAhead);
  const Piece after = scan.piece(467, 600, test::kLineAside);
  EXPECT_FALSE(Merging(scan.beams, scan.noise, scan.config).merge(before, after));
}

}  // namespace
}  // namespace sightline::lines
