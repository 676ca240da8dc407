#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "lines/room_scan.h"
#include "sightline/lines/line_extractor.h"

// Conditions for a wall, and its ends.
namespace sightline::lines {
namespace {

using geometry::EndKind;
using geometry::LineSegment;
using test::Gauss;
using test::kNan;
using test::ScanOf;

std::vector<LineSegment> linesOf(const ScanOf& of, const scan::Scan& scan) {
  scan::Scan known = scan;
  scan::applyNoise(of.noise, known);
  return LineExtractor().extract(known);
}

TEST(Walls, BadReturnsDoNotCutThem) {
  Gauss gauss(31);
  const ScanOf of = test::room();
  for (int i = 0; i < 100; ++i) {
    scan::Scan scan = of.take(gauss);
    for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
      double range = scan.ranges()[beam];
      const double chance = gauss.uniform(0.0, 1.0);
      if (chance < 0.02) range = kNan;
      if (chance > 0.02 && chance < 0.04) range = std::numeric_limits<double>::infinity();
      if (chance > 0.04 && chance < 0.06) range = 0.0;
      if (chance > 0.06 && chance < 0.07) range = gauss.uniform(0.5, 4.0);  // stray
      scan.setRange(beam, range);
    }
    EXPECT_EQ(linesOf(of, scan).size(), 5U);
  }
}

TEST(Walls, MissingReturnsInterruptThemBeyondTheGapLimit) {
  Gauss gauss(32);
  const ScanOf of = test::wallAhead(2.0, -2.0, 2.0);
  for (const bool wide : {false, true}) {
    scan::Scan scan = of.take(gauss);
    for (std::size_t i = 0; i < scan.beams(); ++i) {
      const double x = 2.0 / std::tan(scan.geometry()->angles()[i]);
      if (std::abs(x) < (wide ? 0.2 : 0.1)) scan.setRange(i, kNan);
    }
    EXPECT_EQ(linesOf(of, scan).size(), wide ? 2U : 1U);
  }
}

// A pane of 1.5 m that nothing comes back from, seen at a grazing angle by four beams.
TEST(Walls, APaneSeenByFewBeamsInterruptsThem) {
  ScanOf of = test::wallAhead(0.5, 0.0, 3.0);
  of.walls.push_back({{4.5, 0.5}, {16.0, 0.5}});
  of.angle_increment = geometry::radians(0.7);
  of.beams = 258;
  LineExtractorConfig config;
  config.min_beams = 3;
  config.min_length = 0.1;
  scan::Scan scan = of.takeWithoutNoise();
  std::size_t lost = 0;
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const double x = 0.5 / std::tan(scan.geometry()->angles()[i]);
    if (x > 3.0 && x < 4.5) ++lost;
  }
  ASSERT_EQ(lost, 4U);
  EXPECT_EQ(LineExtractor(config).extract(scan).size(), 2U);
}

TEST(Walls, AnOpeningSeparatesThem) {
  Gauss gauss(33);
  ScanOf of = test::wallAhead(2.0, -2.0, -0.5);
  of.walls.push_back({{0.5, 2.0}, {2.0, 2.0}});
  of.walls.push_back({{-5.0, 4.0}, {5.0, 4.0}});
  for (int i = 0; i < 100; ++i) {
    const auto segments = linesOf(of, of.take(gauss));
    std::size_t near = 0;
    for (const LineSegment& segment : segments) {
      if (std::abs(segment.line.rho - 2.0) > 0.1) continue;
      ++near;
      EXPECT_LT(segment.ends.length(), 1.6);
    }
    EXPECT_EQ(near, 2U);
  }
}

// Far along a corridor one beam alone goes into a door, and where it ends tells.
TEST(Walls, OneBeamThatPassesThroughIsAnOpeningWhereBeamsAreFarApart) {
  Gauss gauss(36);
  for (const bool is_open : {false, true}) {
    ScanOf of = test::wallAhead(1.0, -12.0, -0.5);
    of.noise.sigma = 0.005;
    scan::Scan scan = of.take(gauss);
    // Beams meet the wall 0.4 to 0.6 m apart, 10 m on.
    std::size_t at = scan.beams() - 1;
    while (!scan.isValid(at) || std::abs(scan.point(at).x()) > 9.0) --at;
    if (is_open) scan.setRange(at, scan.ranges()[at] + 1.0);
    const auto segments = linesOf(of, scan);
    double longest = 0.0;
    for (const LineSegment& segment : segments) {
      longest = std::max(longest, segment.ends.length());
    }
    EXPECT_EQ(longest > 9.0, !is_open);
  }
}

TEST(Walls, AThinPostInFrontDoesNotInterruptThem) {
  Gauss gauss(34);
  ScanOf of = test::wallAhead(2.0, -2.0, 2.0);
  of.posts.push_back({{0.3, 1.5}, 0.03});
  for (int i = 0; i < 100; ++i) {
    const auto segments = linesOf(of, of.take(gauss));
    ASSERT_EQ(segments.size(), 1U);
    EXPECT_NEAR(segments[0].ends.length(), 4.0, 0.05);
  }
}

TEST(Walls, RoundThingsAreNone) {
  Gauss gauss(35);
  for (const double radius : {0.05, 0.1, 0.2, 0.4}) {
    ScanOf of;
    for (const double x : {1.0, 2.0, 3.0}) of.posts.push_back({{x, 0.5 * x * x - 2.0}, radius});
    for (int i = 0; i < 50; ++i) EXPECT_EQ(linesOf(of, of.take(gauss)).size(), 0U) << radius;
  }
}

TEST(Walls, ABendMakesTwo) {
  Gauss gauss(36);
  ScanOf of;
  of.angle_min = 0.0;
  of.beams = 721;
  const double bend = geometry::radians(15.0);
  of.walls = {{{2.0, 2.0}, {0.0, 2.0}},
              {{0.0, 2.0}, {-2.0 * std::cos(bend), 2.0 + 2.0 * std::sin(bend)}}};
  for (int i = 0; i < 100; ++i) {
    const auto segments = linesOf(of, of.take(gauss));
    ASSERT_EQ(segments.size(), 2U);
    EXPECT_EQ(segments[0].end_kind, EndKind::kCorner);
    EXPECT_EQ(segments[1].start_kind, EndKind::kCorner);
    EXPECT_NEAR(segments[0].ends.end.x(), 0.0, 0.1);
  }
}

// A wall that ends, a nearer one that hides it, the edge of the field of view.
TEST(Ends, KnowWhyTheWallEnds) {
  Gauss gauss(37);
  ScanOf of = test::wallAhead(3.0, -9.0, 2.0);
  of.angle_min = 0.25 * geometry::kPi;
  of.beams = 361;
  of.walls.push_back({{-0.5, 1.5}, {0.5, 1.5}});
  of.walls.push_back({{-20.0, 6.0}, {20.0, 6.0}});
  for (int i = 0; i < 20; ++i) {
    const auto segments = linesOf(of, of.take(gauss));
    ASSERT_EQ(segments.size(), 4U);
    // Seen from the right: the far wall, the end of the near one, the box before it, the near wall
    // again.
    EXPECT_EQ(segments[0].start_kind, EndKind::kScanLimit);
    EXPECT_EQ(segments[0].end_kind, EndKind::kOccluded);
    EXPECT_EQ(segments[1].start_kind, EndKind::kOccludingEdge);
    EXPECT_EQ(segments[1].end_kind, EndKind::kOccluded);
    EXPECT_EQ(segments[2].start_kind, EndKind::kOccludingEdge);
    EXPECT_EQ(segments[2].end_kind, EndKind::kOccludingEdge);
    EXPECT_EQ(segments[3].start_kind, EndKind::kOccluded);
    EXPECT_EQ(segments[3].end_kind, EndKind::kScanLimit);
    EXPECT_NEAR(segments[1].ends.start.x(), 2.0, 0.03);
    EXPECT_NEAR(segments[2].ends.start.x(), 0.5, 0.02);
  }
}

TEST(Ends, OfTheSensorsRangeAreLimits) {
  Gauss gauss(38);
  ScanOf of = test::wallAhead(2.0, -9.0, 9.0);
  of.range_max = 4.0;
  const auto segments = linesOf(of, of.take(gauss));
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_EQ(segments[0].start_kind, EndKind::kScanLimit);
  EXPECT_EQ(segments[0].end_kind, EndKind::kScanLimit);
}

TEST(EndsStatistics, CornersErrAsMuchAsTheySay) {
  Gauss gauss(39);
  const ScanOf of = test::room();
  double squares = 0.0;
  double count = 0.0;
  for (int i = 0; i < 1000; ++i) {
    for (const LineSegment& segment : linesOf(of, of.take(gauss))) {
      if (segment.end_kind != EndKind::kCorner) continue;
      for (const auto& wall : of.walls) {
        if ((wall.start - segment.ends.end).norm() > 0.1) continue;
        const double error = segment.ends.direction().dot(segment.ends.end - wall.start);
        squares += error * error / (segment.end_sigma * segment.end_sigma);
        ++count;
      }
    }
  }
  ASSERT_GT(count, 3000.0);
  EXPECT_NEAR(squares / count, 1.0, 0.1);
}

TEST(EndsStatistics, FreeOnesErrAsMuchAsTheySay) {
  Gauss gauss(40);
  double squares = 0.0;
  double count = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double end = gauss.uniform(0.5, 1.5);
    ScanOf of = test::wallAhead(2.0, -1.0, end);
    of.walls.push_back({{-20.0, 6.0}, {20.0, 6.0}});
    for (const LineSegment& segment : linesOf(of, of.take(gauss))) {
      if (std::abs(segment.line.rho - 2.0) > 0.1) continue;
      ASSERT_EQ(segment.start_kind, EndKind::kOccludingEdge);
      const double error =
          segment.ends.direction().dot(segment.ends.start - Eigen::Vector2d(end, 2.0));
      squares += error * error / (segment.start_sigma * segment.start_sigma);
      ++count;
    }
  }
  EXPECT_NEAR(squares / count, 1.0, 0.15);
}

}  // namespace
}  // namespace sightline::lines
