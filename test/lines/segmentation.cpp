#include "sightline/lines/segmentation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lines/corner_scan.h"
#include "lines/turning_walls.h"
#include "sightline/lines/line_extractor.h"

namespace sightline::lines {
namespace {

using test::Gauss;
using test::ScanOf;
using test::SmallScan;

std::vector<Piece> dividedInto(const BeamArray& beams, std::size_t end) {
  Segmentation segmentation({});
  segmentation.reserve(beams.revolution);
  std::vector<Piece> pieces;
  segmentation.divide(beams, 0, end, pieces);
  return pieces;
}
std::vector<Piece> dividedInto(const BeamArray& beams) {
  return dividedInto(beams, beams.revolution);
}

TEST(Segmentation, FindsTheWallsOfACorner) {
  const SmallScan scan = test::cornerScan();
  const auto pieces = dividedInto(scan.beams);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].first, 0U);
  EXPECT_EQ(pieces[0].end, scan.at(test::kFirstAside));
  EXPECT_EQ(pieces[1].first, pieces[0].end);
  EXPECT_EQ(pieces[1].end, scan.beams.revolution);
  EXPECT_NEAR(pieces[0].line.rho, 2.0, 1e-4);
  EXPECT_NEAR(pieces[0].line.normal_y, 1.0, 1e-5);
  EXPECT_NEAR(pieces[1].line.normal_x, -1.0, 1e-5);
}

TEST(Segmentation, StopsAtTheEndItIsGiven) {
  const SmallScan scan = test::cornerScan();
  const auto pieces = dividedInto(scan.beams, scan.at(301));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].end, scan.at(301));
}

TEST(Segmentation, NeedsEnoughReturns) {
  const SmallScan scan = test::cornerScan();
  EXPECT_TRUE(dividedInto(scan.beams, Segmentation::kFewest - 1).empty());
}

TEST(Segmentation, NoLineGoesOnAcrossAGap) {
  ScanOf of = test::wallAhead(2.0, -1.0, 2.0);
  of.walls = {{{-1.0, 2.0}, {0.0, 2.0}}, {{0.5, 2.0}, {2.0, 2.0}}};
  const SmallScan scan(of);
  const auto pieces = dividedInto(scan.beams);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].end, pieces[1].first);
  EXPECT_GT(scan.beams.beam[pieces[1].first] - scan.beams.beam[pieces[1].first - 1], 4U);
}

TEST(Segmentation, FindsNothingWhereNoLineExplainsTheReturns) {
  const ScanOf of = test::wallAhead(2.0, -1.0, 2.0);
  std::vector<double> ranges;
  for (std::size_t i = 0; i < of.beams; ++i) {
    ranges.push_back(2.0 + 0.5 * static_cast<double>(i * i % 7));
  }
  BeamArray beams;
  beams.assign(of.withRanges(std::move(ranges)));
  EXPECT_TRUE(dividedInto(beams).empty());
}

// Wherever in an atom it lies.
TEST(Segmentation, AStrayReturnInFrontDoesNotCutALine) {
  for (std::size_t stray = 300; stray < 312; ++stray) {
    SmallScan scan(test::wallAhead(2.0, -1.0, 2.0));
    scan.scan.setRange(stray, 1.0);
    scan.beams.assign(scan.scan);
    EXPECT_EQ(dividedInto(scan.beams).size(), 1U) << stray;
  }
}

TEST(Segmentation, FindsObtuseCorners) {
  Gauss gauss(1);
  BeamArray beams;
  for (const double degrees : {10.0, 20.0, 30.0}) {
    const double turn = geometry::radians(degrees);
    beams.assign(test::wallsThatTurn(turn, 0.03).take(gauss));
    const auto pieces = dividedInto(beams);
    ASSERT_EQ(pieces.size(), 2U) << degrees;
    EXPECT_EQ(pieces[0].end, pieces[1].first);
    const double bend = pieces[0].line.normal_x * pieces[1].line.normal_y -
                        pieces[0].line.normal_y * pieces[1].line.normal_x;
    EXPECT_NEAR(bend, std::sin(turn), 0.05);
    EXPECT_LT(std::abs(beams.x[pieces[1].first]), 0.2F) << degrees;
  }
}

TEST(SegmentationStatistics, LeavesAStraightWallWhole) {
  Gauss gauss(2);
  BeamArray beams;
  int divided = 0;
  for (int i = 0; i < 500; ++i) {
    beams.assign(test::wallsThatTurn(0.0, 0.03).take(gauss));
    if (dividedInto(beams).size() > 1) ++divided;
  }
  EXPECT_EQ(divided, 0);
}

// Both walls are much better known than the place where unconstrained lines would part.
TEST(SegmentationStatistics, BreaksLieWhereTheWallsMeet) {
  Gauss gauss(3);
  BeamArray beams;
  double squares = 0.0;
  for (int i = 0; i < 200; ++i) {
    beams.assign(test::wallsThatTurn(geometry::radians(15.0), 0.02).take(gauss));
    const auto pieces = dividedInto(beams);
    ASSERT_EQ(pieces.size(), 2U);
    squares += std::pow(static_cast<double>(beams.x[pieces[1].first]), 2);
  }
  EXPECT_LT(std::sqrt(squares / 200.0), 0.05);
}

TEST(Segmentation, WallsThatMeetAtObtuseAnglesAreTwoWithTheirCorner) {
  Gauss gauss(4);
  LineExtractor extractor;
  for (const double degrees : {10.0, 20.0, 30.0}) {
    const ScanOf of = test::wallsThatTurn(geometry::radians(degrees), 0.01);
    int found = 0;
    for (int i = 0; i < 100; ++i) {
      const auto& segments = extractor.extract(of.take(gauss));
      if (segments.size() != 2) continue;
      ++found;
      EXPECT_LT((segments[0].ends.end - Eigen::Vector2d(0.0, 3.0)).norm(), 0.1);
    }
    EXPECT_GE(found, 99) << degrees;
  }
}

// A bow of 1 cm over six metres.
TEST(Segmentation, AWallThatIsNotQuiteStraightIsOne) {
  Gauss gauss(5);
  scan::Scan scan = test::wallsThatTurn(0.0, 0.003).take(gauss);
  scan.setRangeVariances(std::vector<double>(scan.beams(), 0.005 * 0.005));
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    const double x = scan.point(i).x();
    scan.setRange(i, scan.ranges()[i] + 0.01 * (1.0 - x * x / 9.0));
  }
  BeamArray beams;
  beams.assign(scan);
  EXPECT_EQ(dividedInto(beams).size(), 1U);
}

TEST(Segmentation, AStepIsNoUnevenness) {
  Gauss gauss(6);
  BeamArray beams;
  for (const double step : {-0.04, 0.04}) {
    ScanOf of = test::wallAhead(2.0, 0.0, 2.0);
    of.walls.push_back({{-2.0, 2.0 + step}, {0.0, 2.0 + step}});
    of.noise.sigma = 0.01;
    for (int i = 0; i < 50; ++i) {
      beams.assign(of.take(gauss));
      EXPECT_GE(dividedInto(beams).size(), 2U) << step;
    }
  }
}

}  // namespace
}  // namespace sightline::lines
