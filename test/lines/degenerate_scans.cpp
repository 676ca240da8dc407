#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "lines/room_scan.h"
#include "sightline/lines/line_extractor.h"

// Scans that are hardly any: there is nothing to find in them, and nothing may break.
namespace sightline::lines {
namespace {

using test::Gauss;
using test::kNan;
using test::ScanOf;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

scan::Scan withRanges(std::vector<double> ranges, bool circle = false) {
  ScanOf of;
  of.beams = ranges.size();
  if (circle) of.angle_increment = 2.0 * geometry::kPi / static_cast<double>(of.beams);
  return of.withRanges(std::move(ranges));
}

std::size_t count(const scan::Scan& scan) {
  LineExtractor extractor;
  const auto& segments = extractor.extract(scan);
  for (const auto& segment : segments) {
    EXPECT_TRUE(segment.line.covariance.allFinite());
    EXPECT_TRUE(segment.ends.start.allFinite());
    EXPECT_TRUE(segment.ends.end.allFinite());
    EXPECT_TRUE(std::isfinite(segment.start_sigma));
    EXPECT_TRUE(std::isfinite(segment.end_sigma));
  }
  return segments.size();
}

TEST(DegenerateScan, HoldsNoLines) {
  for (const bool circle : {false, true}) {
    for (const double nothing : {kNan, kInfinity, -kInfinity, 0.0, -1.0, 1e9, 1e-3}) {
      EXPECT_EQ(count(withRanges(std::vector<double>(400, nothing), circle)), 0U) << nothing;
    }
  }
  for (const std::size_t beams : {1U, 2U, 3U, 4U, 5U, 8U, 9U}) {
    EXPECT_EQ(count(withRanges(std::vector<double>(beams, 2.0))), 0U) << beams << " beams";
  }
}

TEST(DegenerateScan, FewValidBeamsAmongMany) {
  for (const std::size_t valid : {1U, 2U, 3U, 5U, 9U}) {
    std::vector<double> ranges(400, kNan);
    for (std::size_t i = 0; i < valid; ++i) ranges[100 + i] = 2.0;
    EXPECT_EQ(count(withRanges(ranges)), 0U) << valid;
    ranges.assign(400, kNan);
    for (std::size_t i = 0; i < valid; ++i) ranges[40 * i] = 2.0;
    EXPECT_EQ(count(withRanges(ranges, true)), 0U) << valid;
  }
}

// Equal ranges are an arc about the sensor, no wall.
TEST(DegenerateScan, RepeatedRangesAreNoWall) {
  EXPECT_EQ(count(withRanges(std::vector<double>(720, 2.0))), 0U);
  EXPECT_EQ(count(withRanges(std::vector<double>(720, 2.0), true)), 0U);
}

TEST(DegenerateScan, ClutterIsNoWall) {
  Gauss gauss(11);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> ranges;
    for (int k = 0; k < 720; ++k) ranges.push_back(gauss.uniform(0.5, 6.0));
    EXPECT_EQ(count(withRanges(ranges, i % 2 == 0)), 0U);
  }
}

TEST(DegenerateScan, RangesBeyondTheLimitsAreNotUsed) {
  Gauss gauss(12);
  ScanOf room = test::room();
  room.range_max = 3.0;
  const scan::Scan scan = room.take(gauss);
  LineExtractor extractor;
  for (const auto& segment : extractor.extract(scan)) {
    EXPECT_LT(segment.ends.start.norm(), 3.1);
    EXPECT_LT(segment.ends.end.norm(), 3.1);
  }
}

TEST(DegenerateScan, ExtremeVariancesDoNoHarm) {
  Gauss gauss(13);
  scan::Scan scan = test::room().take(gauss);
  for (const double variance : {1e-14, 1e-10, 1.0, 1e6}) {
    scan.setRangeVariances(std::vector<double>(scan.beams(), variance));
    count(scan);
  }
}

// Every second return is missing, or every third alone is there.
TEST(DegenerateScan, RegularlyMissingReturnsLeaveTheWalls) {
  Gauss gauss(14);
  for (const std::size_t period : {2U, 3U}) {
    scan::Scan scan = test::room().take(gauss);
    for (std::size_t i = 0; i < scan.beams(); ++i) {
      if (i % period != 0) scan.setRange(i, kNan);
    }
    EXPECT_EQ(count(scan), 5U);
  }
}

}  // namespace
}  // namespace sightline::lines
