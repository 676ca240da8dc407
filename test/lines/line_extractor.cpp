#include "sightline/lines/line_extractor.h"

#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "config_error.h"
#include "lines/room_scan.h"

namespace sightline::lines {
namespace {

using geometry::EndKind;
using geometry::LineSegment;
using test::Gauss;
using test::ScanOf;

std::vector<LineSegment> extract(const scan::Scan& scan, const LineExtractorConfig& config = {}) {
  return LineExtractor(config).extract(scan);
}

TEST(LineExtractor, FindsEachWallOfARoomOnce) {
  Gauss gauss(1);
  LineExtractor extractor;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(extractor.extract(test::room().take(gauss)).size(), 5U);
}

TEST(LineExtractor, OneSetOfSettingsServesCoarseAndFineSensorsOfAnyNoise) {
  Gauss gauss(2);
  for (const double degrees : {0.25, 0.5, 1.0}) {
    for (const double sigma : {0.001, 0.01, 0.03}) {
      ScanOf scan = test::room();
      scan.angle_increment = geometry::radians(degrees);
      scan.beams = static_cast<std::size_t>(std::lround(270.0 / degrees)) + 1;
      scan.noise.sigma = sigma;
      EXPECT_EQ(extract(scan.take(gauss)).size(), 5U) << degrees << " degrees, " << sigma << " m";
    }
  }
}

TEST(LineExtractor, SegmentsComeInTheOrderOfTheSweepWithTheirBeams) {
  Gauss gauss(3);
  const auto segments = extract(test::room().take(gauss));
  ASSERT_EQ(segments.size(), 5U);
  std::size_t next = 0;
  for (const LineSegment& segment : segments) {
    EXPECT_NEAR(static_cast<double>(segment.first_beam), static_cast<double>(next), 3.0);
    EXPECT_LT(segment.first_beam, segment.last_beam);
    EXPECT_LE(segment.beams, segment.last_beam + 1 - segment.first_beam);
    EXPECT_EQ(segment.degrees_of_freedom, segment.beams - 2);
    EXPECT_NEAR(segment.chi_square / static_cast<double>(segment.degrees_of_freedom), 1.0, 0.5);
    EXPECT_EQ(segment.id, 0U);
    next = segment.last_beam + 1;
  }
  EXPECT_EQ(next, 1081U);
}

TEST(LineExtractor, StaysInTheFormatOfPolarLines) {
  Gauss gauss(4);
  for (const LineSegment& segment : extract(test::room().take(gauss))) {
    EXPECT_GE(segment.line.rho, 0.0);
    EXPECT_LE(std::abs(segment.line.phi), geometry::kPi);
    EXPECT_NEAR(segment.line.signedDistance(segment.ends.start), 0.0, 1e-9);
    EXPECT_NEAR(segment.line.signedDistance(segment.ends.end), 0.0, 1e-9);
    EXPECT_EQ(segment.line.covariance(0, 1), segment.line.covariance(1, 0));
    EXPECT_GT(segment.line.covariance.determinant(), 0.0);
  }
}

TEST(LineExtractor, FullCircleHasNoSeam) {
  Gauss gauss(5);
  for (const double start : {-3.14159, -2.0, 0.0, 1.0, 2.5}) {
    ScanOf scan = test::room();
    scan.angle_min = start;
    scan.angle_increment = geometry::radians(0.5);
    scan.beams = 720;
    const auto segments = extract(scan.take(gauss));
    ASSERT_EQ(segments.size(), 4U) << "starting at " << start;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(segments[i].start_kind, EndKind::kCorner);
      EXPECT_EQ(segments[i].end_kind, EndKind::kCorner);
      const bool crosses = segments[i].first_beam > segments[i].last_beam;
      EXPECT_TRUE(!crosses || i == 3) << "the one across the seam comes last";
      if (i == 0) continue;
      EXPECT_GT(segments[i].first_beam, segments[i - 1].first_beam);
    }
  }
}

TEST(LineExtractor, ASensorThatRepeatsItsFirstBeamIsAFullCircleToo) {
  Gauss gauss(6);
  ScanOf scan = test::room();
  scan.angle_min = 0.3;
  scan.angle_increment = geometry::radians(0.5);
  scan.beams = 721;
  EXPECT_EQ(extract(scan.take(gauss)).size(), 4U);
}

TEST(LineExtractor, ASensorThatTurnsTheOtherWaySeesTheSameLines) {
  Gauss gauss(7);
  for (int i = 0; i < 50; ++i) {
    const ScanOf forward = test::room();
    ScanOf backward = forward;
    backward.angle_min = -forward.angle_min;
    backward.angle_increment = -forward.angle_increment;
    const scan::Scan scan = forward.take(gauss);
    const scan::Scan reversed = backward.withRanges({scan.ranges().rbegin(), scan.ranges().rend()});
    const auto there = extract(scan);
    const auto back = extract(reversed);
    ASSERT_EQ(there.size(), back.size());
    for (std::size_t k = 0; k < there.size(); ++k) {
      const LineSegment& a = there[k];
      const LineSegment& b = back[back.size() - 1 - k];
      const Eigen::Vector2d difference = geometry::difference(a.line, b.line);
      const Eigen::Vector2d sigma = a.line.covariance.diagonal().cwiseSqrt();
      EXPECT_LT(std::abs(difference[0]), 0.5 * sigma[0]);
      EXPECT_LT(std::abs(difference[1]), 0.5 * sigma[1]);
      EXPECT_LT((a.ends.start - b.ends.end).norm(), 3.0 * a.start_sigma + 0.005);
      EXPECT_LT((a.ends.end - b.ends.start).norm(), 3.0 * a.end_sigma + 0.005);
    }
  }
}

TEST(LineExtractor, ScansMayChangeTheirSize) {
  Gauss gauss(8);
  LineExtractor extractor;
  for (const std::size_t beams : {1081U, 271U, 1U, 541U, 1081U, 3U}) {
    ScanOf scan = test::room();
    scan.beams = beams;
    const scan::Scan taken = scan.take(gauss);
    EXPECT_EQ(extractor.extract(taken).size(), extract(taken).size());
  }
}

TEST(LineExtractor, SettingsDecideWhatIsLongEnough) {
  Gauss gauss(9);
  ScanOf scan = test::wallAhead(2.0, -0.4, 0.4);
  const scan::Scan taken = scan.take(gauss);
  LineExtractorConfig config;
  EXPECT_EQ(extract(taken, config).size(), 1U);
  config.min_length = 1.0;
  EXPECT_EQ(extract(taken, config).size(), 0U);
  config.min_length = 0.5;
  config.min_beams = 200;
  EXPECT_EQ(extract(taken, config).size(), 0U);
}

TEST(LineExtractor, RefusesSettingsOutOfRange) {
  const auto keyOf = [](const LineExtractorConfig& config) {
    return test::errorOf([&] { LineExtractor extractor(config); }).key();
  };
  LineExtractorConfig config;
  config.gate = 0.0;
  EXPECT_EQ(keyOf(config), "gate");
  config = {};
  config.max_gap = -0.1;
  EXPECT_EQ(keyOf(config), "max_gap");
  config = {};
  config.min_length = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(keyOf(config), "min_length");
}

}  // namespace
}  // namespace sightline::lines
