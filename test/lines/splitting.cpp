#include "sightline/lines/splitting.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lines/corner_scan.h"
#include "sightline/lines/line_extractor.h"

namespace sightline::lines {
namespace {

using test::Gauss;
using test::ScanOf;

// Two walls of three metres that meet ahead of the sensor and turn by so much there.
ScanOf wallsThatTurn(double turn, double sigma) {
  ScanOf of = test::wallAhead(3.0, 0.0, 3.0);
  const Eigen::Vector2d corner(0.0, 3.0);
  of.walls.push_back({corner, corner + 3.0 * Eigen::Vector2d(-std::cos(turn), -std::sin(turn))});
  of.noise.sigma = sigma;
  return of;
}

// All returns as one piece, with the line through them.
Piece wholeOf(const BeamArray& beams, const LineExtractorConfig& config) {
  Piece piece;
  piece.end = beams.revolution;
  piece.line = {0.0, 1.0, 2.8, {}};
  for (int i = 0; i < 3; ++i) refine(beams, 1e4 * config.gate, piece);
  return piece;
}

TEST(Splitting, FindsTheCornerOfAChord) {
  Gauss gauss(1);
  const LineExtractorConfig config;
  BeamArray beams;
  for (const double degrees : {10.0, 20.0, 30.0}) {
    const double turn = geometry::radians(degrees);
    beams.assign(wallsThatTurn(turn, 0.03).take(gauss));
    std::vector<Piece> parts;
    ASSERT_TRUE(Splitting(beams, config).split(wholeOf(beams, config), parts)) << degrees;
    ASSERT_EQ(parts.size(), 2U) << degrees;
    EXPECT_EQ(parts[0].end, parts[1].first);
    const double bend = parts[0].line.normal_x * parts[1].line.normal_y -
                        parts[0].line.normal_y * parts[1].line.normal_x;
    EXPECT_NEAR(bend, std::sin(turn), 0.05);
  }
}

TEST(Splitting, LeavesAStraightWallWhole) {
  Gauss gauss(2);
  const LineExtractorConfig config;
  BeamArray beams;
  for (int i = 0; i < 500; ++i) {
    beams.assign(wallsThatTurn(0.0, 0.03).take(gauss));
    std::vector<Piece> parts;
    EXPECT_FALSE(Splitting(beams, config).split(wholeOf(beams, config), parts));
    EXPECT_EQ(parts.size(), 1U);
  }
}

TEST(Splitting, PutsAWrongBreakRight) {
  Gauss gauss(3);
  const LineExtractorConfig config;
  BeamArray beams;
  beams.assign(wallsThatTurn(geometry::radians(15.0), 0.02).take(gauss));
  std::size_t corner = 0;
  while (beams.x[corner] > 0.0F) ++corner;
  for (const std::size_t at : {corner - 40, corner + 40}) {
    const Piece whole = wholeOf(beams, config);
    Piece before = whole;
    Piece after = whole;
    before.end = after.first = at;
    ASSERT_TRUE(refine(beams, config.gate * config.gate, before));
    ASSERT_TRUE(refine(beams, config.gate * config.gate, after));
    ASSERT_TRUE(Splitting(beams, config).settle(before, after));
    EXPECT_EQ(before.end, after.first);
    EXPECT_NEAR(static_cast<double>(before.end), static_cast<double>(corner), 12.0);
  }
}

TEST(Splitting, WallsThatMeetAtObtuseAnglesAreTwoWithTheirCorner) {
  Gauss gauss(4);
  LineExtractor extractor;
  for (const double degrees : {10.0, 20.0, 30.0}) {
    const ScanOf of = wallsThatTurn(geometry::radians(degrees), 0.01);
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

TEST(Unevenness, RaisesTheCovarianceOfAWallThatIsNotStraightAlone) {
  Gauss gauss(5);
  const LineExtractorConfig config;
  const double gate_squared = config.gate * config.gate;
  BeamArray beams;
  double sum = 0.0;
  for (int i = 0; i < 200; ++i) {
    beams.assign(wallsThatTurn(0.0, 0.01).take(gauss));
    Piece piece = wholeOf(beams, config);
    ASSERT_TRUE(refine(beams, gate_squared, piece));
    sum += unevenness(beams, gate_squared, piece);
  }
  EXPECT_NEAR(sum / 200.0, 1.0, 0.1);
  // A bow of 1 cm over six metres.
  scan::Scan scan = wallsThatTurn(0.0, 0.01).take(gauss);
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    if (!scan.isValid(i)) continue;
    const double x = scan.point(i).x();
    scan.setRange(i, scan.ranges()[i] + 0.02 * (1.0 - x * x / 9.0));
  }
  beams.assign(scan);
  Piece piece = wholeOf(beams, config);
  ASSERT_TRUE(refine(beams, gate_squared, piece));
  EXPECT_GT(unevenness(beams, gate_squared, piece), 5.0);
}

}  // namespace
}  // namespace sightline::lines
