#include "sightline/lines/line_filter.h"

#include <gtest/gtest.h>

#include "lines/corner_scan.h"

namespace sightline::lines {
namespace {

using test::SmallScan;

TEST(LineFilter, FollowsAWallToItsEnd) {
  const SmallScan scan = test::cornerScan();
  LineFilter filter(scan.beams, scan.noise, scan.config);
  ASSERT_TRUE(filter.start(scan.at(200), scan.beams.size));
  const Piece piece = filter.follow(scan.beams.size);
  EXPECT_EQ(piece.first, scan.at(200));
  EXPECT_GE(piece.end, scan.at(test::kFirstAside));
  EXPECT_LE(piece.end, scan.at(test::kLastNearAhead + 2));
  EXPECT_NEAR(piece.line.rho, 2.0, 1e-3);
  EXPECT_NEAR(piece.line.normal_y, 1.0, 1e-5);
  EXPECT_DOUBLE_EQ(piece.beams, static_cast<double>(piece.size()));
}

TEST(LineFilter, StopsAtTheEndItIsGiven) {
  const SmallScan scan = test::cornerScan();
  LineFilter filter(scan.beams, scan.noise, scan.config);
  ASSERT_TRUE(filter.start(scan.at(200), scan.at(301)));
  EXPECT_EQ(filter.follow(scan.at(301)).end, scan.at(301));
}

TEST(LineFilter, NeedsEnoughReturnsToStart) {
  const SmallScan scan = test::cornerScan();
  LineFilter filter(scan.beams, scan.noise, scan.config);
  EXPECT_FALSE(filter.start(0, LineFilter::kFewestToStart - 1));
}

TEST(LineFilter, DoesNotStartOverAGap) {
  test::ScanOf of = test::wallAhead(2.0, -1.0, 2.0);
  of.walls = {{{-1.0, 2.0}, {0.0, 2.0}}, {{0.5, 2.0}, {2.0, 2.0}}};
  const SmallScan scan(of);
  LineFilter filter(scan.beams, scan.noise, scan.config);
  std::size_t gap = 1;
  while (scan.beams.beam[gap] - scan.beams.beam[gap - 1] == 1) ++gap;
  EXPECT_FALSE(filter.start(gap - 3, scan.beams.size));
  EXPECT_TRUE(filter.start(gap, scan.beams.size));
}

TEST(LineFilter, DoesNotStartWhereNoLineExplainsTheReturns) {
  test::ScanOf of = test::wallAhead(2.0, -1.0, 2.0);
  std::vector<double> ranges;
  for (std::size_t i = 0; i < of.beams; ++i) ranges.push_back(i % 2 == 0 ? 2.0 : 2.5);
  SmallScan scan(of);
  scan.scan = of.withRanges(std::move(ranges));
  scan.beams.assign(scan.scan);
  LineFilter filter(scan.beams, scan.noise, scan.config);
  EXPECT_FALSE(filter.start(0, scan.beams.size));
}

TEST(LineFilter, BridgesAStrayReturn) {
  test::ScanOf of = test::wallAhead(2.0, -1.0, 2.0);
  SmallScan scan(of);
  scan.scan.setRange(320, 1.0);
  scan.beams.assign(scan.scan);
  LineFilter filter(scan.beams, scan.noise, scan.config);
  ASSERT_TRUE(filter.start(scan.at(200), scan.beams.size));
  const Piece piece = filter.follow(scan.beams.size);
  EXPECT_EQ(piece.end, scan.beams.size);
  EXPECT_DOUBLE_EQ(piece.beams, static_cast<double>(piece.size() - 1));
}

}  // namespace
}  // namespace sightline::lines
