#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "lines/room_scan.h"
#include "sightline/lines/line_extractor.h"

// Round things are arcs, and nothing else is.
namespace sightline::lines {
namespace {

using geometry::Arc;
using test::Gauss;
using test::ScanOf;

ScanOf posts(double radius) {
  ScanOf of;
  for (const double x : {1.0, 2.0, 3.0}) of.posts.push_back({{x, 0.5 * x * x - 2.0}, radius});
  return of;
}

TEST(Arcs, EachPostIsOne) {
  Gauss gauss(51);
  for (const double radius : {0.1, 0.2, 0.4}) {
    const ScanOf of = posts(radius);
    for (int i = 0; i < 50; ++i) {
      LineExtractor extractor;
      EXPECT_TRUE(extractor.extract(of.take(gauss)).empty());
      ASSERT_EQ(extractor.arcs().size(), 3U) << radius;
      for (std::size_t k = 0; k < 3; ++k) {
        const Arc& arc = extractor.arcs()[k];
        EXPECT_NEAR(arc.radius, radius, 5.0 * std::sqrt(arc.covariance(2, 2)));
        EXPECT_LT((arc.centre - of.posts[k].centre).norm(), 0.03);
        EXPECT_EQ(arc.degrees_of_freedom, arc.beams - 1) << "two grazing rays, three parameters";
      }
    }
  }
}

TEST(Arcs, TheSeenPartFacesTheSensor) {
  Gauss gauss(52);
  ScanOf of = posts(0.3);
  for (const double sense : {1.0, -1.0}) {
    of.angle_min = sense * -geometry::radians(135.0);
    of.angle_increment = sense * geometry::radians(0.25);
    LineExtractor extractor;
    extractor.extract(of.take(gauss));
    ASSERT_EQ(extractor.arcs().size(), 3U);
    for (const Arc& arc : extractor.arcs()) {
      EXPECT_GT(arc.end_angle, arc.start_angle);
      EXPECT_LT(arc.end_angle, arc.start_angle + geometry::kPi);
      const double middle = 0.5 * (arc.start_angle + arc.end_angle);
      const double to_sensor = std::atan2(-arc.centre.y(), -arc.centre.x());
      EXPECT_NEAR(geometry::wrapAngle(middle - to_sensor), 0.0, 0.15);
      EXPECT_LT(arc.first_beam, arc.last_beam);
    }
  }
}

TEST(Arcs, StandBeforeAWall) {
  Gauss gauss(53);
  ScanOf of = test::wallAhead(2.0, -2.0, 2.0);
  of.posts.push_back({{0.3, 1.2}, 0.07});
  for (int i = 0; i < 50; ++i) {
    LineExtractor extractor;
    ASSERT_EQ(extractor.extract(of.take(gauss)).size(), 1U);
    ASSERT_EQ(extractor.arcs().size(), 1U);
    EXPECT_NEAR(extractor.arcs()[0].radius, 0.07, 0.015);
  }
}

// Four boards of one width, each set back from its neighbours.
TEST(Arcs, StepsAreNone) {
  Gauss gauss(59);
  ScanOf of;
  const double set_back[] = {0.05, 0.0, 0.0, 0.05};
  for (int k = 0; k < 4; ++k) {
    const double from = -0.32 + 0.16 * k;
    of.walls.push_back({{from, 2.0 + set_back[k]}, {from + 0.16, 2.0 + set_back[k]}});
  }
  of.noise.sigma = 0.01;
  for (int i = 0; i < 50; ++i) {
    LineExtractor extractor;
    extractor.extract(of.take(gauss));
    EXPECT_TRUE(extractor.arcs().empty());
  }
}

// Residuals of a wall that is not straight leave room for doubt.
TEST(Arcs, TakeNoWallThatGoesOnBehindThem) {
  Gauss gauss(58);
  ScanOf of = test::wallAhead(2.0, -2.0, 2.0);
  of.posts.push_back({{0.3, 1.2}, 0.07});
  of.noise.sigma = 0.013;
  for (int i = 0; i < 50; ++i) {
    scan::Scan scan = of.take(gauss);
    scan.setRangeVariances(std::vector<double>(scan.beams(), 1e-4));
    LineExtractor extractor;
    EXPECT_EQ(extractor.extract(scan).size(), 1U);
    EXPECT_EQ(extractor.arcs().size(), 1U);
  }
}

TEST(Arcs, ARoundRoomIsOneAcrossTheSeam) {
  Gauss gauss(54);
  for (int i = 0; i < 20; ++i) {
    ScanOf of;
    of.angle_increment = geometry::radians(0.5);
    of.beams = 720;
    std::vector<double> ranges(720);
    for (double& range : ranges) range = 1.5 + gauss(0.01);
    const scan::Scan scan = of.withRanges(std::move(ranges));
    LineExtractor extractor;
    EXPECT_TRUE(extractor.extract(scan).empty());
    ASSERT_EQ(extractor.arcs().size(), 1U);
    const Arc& arc = extractor.arcs()[0];
    EXPECT_NEAR(arc.radius, 1.5, 0.003);
    EXPECT_LT(arc.centre.norm(), 0.003);
    EXPECT_GT(arc.end_angle - arc.start_angle, 6.0);
  }
}

TEST(Arcs, APostOnTheSeamIsWhole) {
  Gauss gauss(55);
  ScanOf of = test::room();
  of.posts.push_back({{2.0, 0.5}, 0.2});
  of.angle_min = std::atan2(0.5, 2.0);
  of.angle_increment = geometry::radians(0.5);
  of.beams = 720;
  for (int i = 0; i < 50; ++i) {
    LineExtractor extractor;
    extractor.extract(of.take(gauss));
    ASSERT_EQ(extractor.arcs().size(), 1U);
    EXPECT_GT(extractor.arcs()[0].first_beam, extractor.arcs()[0].last_beam);
    EXPECT_NEAR(extractor.arcs()[0].radius, 0.2, 0.02);
  }
}

TEST(Arcs, WallsAndCornersAreNone) {
  Gauss gauss(56);
  int arcs = 0;
  for (int i = 0; i < 200; ++i) {
    ScanOf of = test::room();
    of.walls.push_back({{1.5, 0.6}, {2.1, 0.5}});  // a board
    of.walls.push_back({{0.5, -1.0}, {1.0, -1.3}});
    of.walls.push_back({{1.0, -1.3}, {1.4, -0.9}});  // the corner of a box
    LineExtractor extractor;
    extractor.extract(of.take(gauss));
    arcs += static_cast<int>(extractor.arcs().size());
  }
  EXPECT_LE(arcs, 2);
}

TEST(Arcs, MayBeSwitchedOff) {
  Gauss gauss(57);
  LineExtractorConfig config;
  config.max_radius = 0.0;
  LineExtractor extractor(config);
  extractor.extract(posts(0.2).take(gauss));
  EXPECT_TRUE(extractor.arcs().empty());
}

}  // namespace
}  // namespace sightline::lines
