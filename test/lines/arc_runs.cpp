#include "sightline/lines/arc_runs.h"

#include <gtest/gtest.h>

#include "lines/corner_scan.h"

namespace sightline::lines {
namespace {

using test::SmallScan;

TEST(ArcRuns, ReturnsBetweenJumpsAreOneRun) {
  test::ScanOf of = test::wallAhead(6.0, -1.0, 1.0);
  of.posts = {{{-2.0, 2.0}, 0.3}};  // apart from the wall
  const SmallScan scan(of);
  ArcRuns runs(scan.config);
  runs.assign(scan.beams, {});
  const auto& found = runs.withDoubtfulWalls();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first, 0U);
  EXPECT_EQ(found[0].end, found[1].first);
  EXPECT_EQ(found[1].end, scan.beams.size);
  EXPECT_LT(scan.beams.y[found[1].first], 3.0F);
  EXPECT_GT(scan.beams.y[found[0].end - 1], 5.0F);
}

TEST(ArcRuns, SureWallIsLeftOut) {
  const SmallScan scan = test::cornerScan();
  const Piece ahead = scan.piece(200, 460, test::kLineAhead);
  ArcRuns runs(scan.config);
  runs.assign(scan.beams, {ahead});
  EXPECT_TRUE(runs.isSureWall(ahead.first));
  EXPECT_TRUE(runs.isSureWall(ahead.end - 1));
  EXPECT_FALSE(runs.isSureWall(ahead.end));
  const auto& found = runs.withDoubtfulWalls();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first, 0U);
  EXPECT_EQ(found[0].end, ahead.first);
  EXPECT_EQ(found[1].first, ahead.end);
  EXPECT_EQ(found[1].end, scan.beams.size);
}

// Residuals beyond the noise, but not so far that it were no wall.
TEST(ArcRuns, WallThatTheNoiseDoesNotExplainIsDoubtful) {
  const SmallScan scan = test::cornerScan();
  Piece ahead = scan.piece(200, 460, test::kLineAhead);
  ahead.chi_square = 2.0 * ahead.beams;
  ArcRuns runs(scan.config);
  runs.assign(scan.beams, {ahead});
  EXPECT_TRUE(runs.isDoubtfulWall(ahead.first));
  const auto all = runs.withDoubtfulWalls();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].size(), scan.beams.size);
  const auto& loose = runs.withoutWalls(all[0]);
  ASSERT_EQ(loose.size(), 2U);
  EXPECT_EQ(loose[0].end, ahead.first);
  EXPECT_EQ(loose[1].first, ahead.end);
}

TEST(ArcRuns, WallLongerThanAnyCircleIsSure) {
  SmallScan scan = test::cornerScan();
  scan.config.max_radius = 0.5;
  Piece ahead = scan.piece(200, 460, test::kLineAhead);
  ahead.chi_square = 2.0 * ahead.beams;
  ArcRuns runs(scan.config);
  runs.assign(scan.beams, {ahead});
  EXPECT_TRUE(runs.isSureWall(ahead.first));
}

}  // namespace
}  // namespace sightline::lines
