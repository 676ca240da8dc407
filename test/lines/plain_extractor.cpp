#include "sightline/lines/plain_extractor.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "lines/noisy_motion.h"
#include "monte_carlo.h"
#include "sightline/motion/sweep.h"

namespace sightline::lines {
namespace {

using geometry::PolarLine;
using geometry::Pose2;

// A turning or standing sensor in front of an endless wall, given in its frame at the stamp.
scan::Scan plainScan(const PolarLine& wall, double turn, double sigma, test::Gauss& gauss) {
  const auto beams = scan::ScanGeometry::uniform(-0.35, 0.7 / 255.0, 256, 4e-4, 0.1, 10.0);
  const Pose2 T_start_end(0.0, 0.0, turn);
  const Pose2 T_head_sensor(0.05, -0.03, 0.0);
  const auto motion = motion::sweepMotion(*beams, T_start_end, T_head_sensor);
  std::vector<double> ranges;
  for (std::size_t i = 0; i < beams->beams(); ++i) {
    const Pose2 pose = motion.empty() ? Pose2() : motion[i];
    const PolarLine seen = geometry::transform(pose.inverse(), wall);
    ranges.push_back(seen.rho / std::cos(seen.phi - beams->angles()[i]) + gauss(sigma));
  }
  scan::Scan scan(beams, 0, std::move(ranges));
  scan.setRangeVariances(std::vector<double>(beams->beams(), sigma * sigma));
  scan.setSensorMotion(motion);
  return scan;
}

// pears section 4: the recursion, with the head still and while it turns. A young line's direction
// is known to σ / l, after a length l, and bends the prediction of eq. 27 by ρ (σ / l)² / 2: with
// so little noise that this is far below σ the recursion is consistent, with more it breaks up.
TEST(PlainExtractor, FollowsAWallWhileTheHeadTurns) {
  test::Gauss gauss(1);
  const PolarLine wall{1.5, 0.2, Eigen::Matrix2d::Zero()};
  LineExtractorConfig config;
  config.gate = 5.0;
  PlainExtractor extractor(config);
  for (const double turn : {0.0, 0.3, -0.3}) {
    int whole = 0;
    test::Moments<1> nees;
    for (int run = 0; run < 300; ++run) {
      const auto& segments = extractor.extract(plainScan(wall, turn, 1e-6, gauss));
      if (segments.size() != 1 || segments[0].beams != 256) continue;
      ++whole;
      const Eigen::Vector2d error = geometry::difference(segments[0].line, wall);
      nees.add(Eigen::Matrix<double, 1, 1>(
          test::normalisedSquare<2>(error, segments[0].line.covariance)));
    }
    EXPECT_GT(whole, 290) << turn;
    EXPECT_NEAR(nees.mean()[0], 2.0, 0.4) << turn;
  }
}

// Beams so close that the recursion does not break up, by a head whose angle walks: the process
// that eqs 21, 23 and 24 are of.
TEST(PlainExtractor, TakesTheNoiseOfTheMotionIntoItsPredictions) {
  test::Gauss gauss(2);
  LineExtractorConfig config;
  config.gate = 5.0;
  PlainExtractor extractor(config);
  test::NoisySweep sweep;
  sweep.scan = test::wallAhead(1.5, -0.6, 0.7);
  sweep.scan.noise.sigma = 1e-5;
  sweep.motion = {0.02, -0.01, 0.3};
  sweep.noise.walk.diagonal() << 1e-8, 1e-8, 1e-6;
  test::Moments<1> nees;
  int whole_where_ignored = 0;
  for (int run = 0; run < 400; ++run) {
    scan::Scan scan = sweep.take(gauss);
    for (const bool known : {true, false}) {
      if (!known) scan.motion_noise = {};
      const auto& segments = extractor.extract(scan);
      if (segments.size() != 1) continue;
      const Eigen::Vector2d error = geometry::difference(segments[0].line, sweep.wall());
      const double squared = test::normalisedSquare<2>(error, segments[0].line.covariance);
      if (!known) ++whole_where_ignored;
      if (known) nees.add(Eigen::Matrix<double, 1, 1>(squared));
    }
  }
  EXPECT_GT(nees.count(), 380);
  EXPECT_NEAR(nees.mean()[0], 2.0, 0.3);
  EXPECT_LT(whole_where_ignored, 200);
}

TEST(PlainExtractor, StartsAnewWhereAnObservationIsNotValidated) {
  test::Gauss gauss(1);
  scan::Scan scan = plainScan({1.5, 0.0, Eigen::Matrix2d::Zero()}, 0.0, 1e-6, gauss);
  const scan::Scan behind = plainScan({2.0, 0.0, Eigen::Matrix2d::Zero()}, 0.0, 1e-6, gauss);
  for (std::size_t i = 128; i < 256; ++i) scan.setRange(i, behind.ranges()[i]);
  LineExtractorConfig config;
  config.gate = 5.0;
  PlainExtractor extractor(config);
  const auto& segments = extractor.extract(scan);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].last_beam, 127u);
  EXPECT_EQ(segments[1].first_beam, 128u);
  EXPECT_NEAR(segments[0].line.rho, 1.5, 1e-5);
  EXPECT_NEAR(segments[1].line.rho, 2.0, 1e-5);
}

TEST(PlainExtractor, SkipsReturnsThatAreNotValid) {
  test::Gauss gauss(1);
  scan::Scan scan = plainScan({1.5, 0.0, Eigen::Matrix2d::Zero()}, 0.0, 1e-6, gauss);
  for (std::size_t i = 0; i < 256; i += 3) {
    scan.setRange(i, std::nan(""));
  }
  LineExtractorConfig config;
  config.gate = 5.0;
  PlainExtractor extractor(config);
  ASSERT_EQ(extractor.extract(scan).size(), 1u);
  for (std::size_t i = 0; i < 256; ++i) scan.setKind(i, scan::ReturnKind::kInvalid);
  EXPECT_TRUE(extractor.extract(scan).empty());
}

// With a start of many returns the direction is known well before the recursion begins.
TEST(PlainExtractor, LongerBatchStartsHoldWithMoreNoise) {
  const PolarLine wall{1.5, 0.2, Eigen::Matrix2d::Zero()};
  std::vector<std::size_t> segments;
  for (const int start_beams : {5, 40}) {
    test::Gauss gauss(3);
    LineExtractorConfig config;
    config.start_beams = start_beams;
    PlainExtractor extractor(config);
    std::size_t count = 0;
    for (int run = 0; run < 50; ++run) {
      count += extractor.extract(plainScan(wall, 0.0, 0.005, gauss)).size();
    }
    segments.push_back(count);
  }
  EXPECT_GT(segments[0], 75U);
  EXPECT_LT(segments[1], 60U);
}

// A wall that ends between two beams.
TEST(PlainExtractor, EndsAreWithinTheirSigmas) {
  test::Gauss gauss(4);
  LineExtractorConfig config;
  config.start_beams = 40;
  PlainExtractor extractor(config);
  int ends = 0;
  int within = 0;
  for (int run = 0; run < 200; ++run) {
    const double from = gauss.uniform(-1.0, -0.8);
    const double to = gauss.uniform(0.8, 1.0);
    const auto& segments = extractor.extract(test::wallAhead(2.0, from, to).take(gauss));
    if (segments.size() != 1) continue;
    const geometry::LineSegment& segment = segments[0];
    ends += 2;
    within += std::abs(segment.ends.start.x() - to) <= 2.0 * segment.start_sigma;
    within += std::abs(segment.ends.end.x() - from) <= 2.0 * segment.end_sigma;
  }
  EXPECT_GT(ends, 200);
  EXPECT_GT(within, 93 * ends / 100);
}

}  // namespace
}  // namespace sightline::lines
