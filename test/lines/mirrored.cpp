#include <gtest/gtest.h>

#include "lines/room_scan.h"
#include "sightline/lines/line_extractor.h"

// A sensor that hangs upside down sees the same room.
namespace sightline::lines {
namespace {

void expectSame(const geometry::LineSegment& a, const geometry::LineSegment& b) {
  EXPECT_LT(geometry::difference(a.line, b.line).norm(), 1e-6);
  EXPECT_LT((a.line.covariance - b.line.covariance).norm(), 1e-3 * b.line.covariance.norm());
  EXPECT_LT((a.ends.start - b.ends.start).norm(), 1e-5);
  EXPECT_LT((a.ends.end - b.ends.end).norm(), 1e-5);
  EXPECT_NEAR(a.start_sigma, b.start_sigma, 1e-5);
  EXPECT_EQ(a.start_kind, b.start_kind);
  EXPECT_EQ(a.end_kind, b.end_kind);
  EXPECT_EQ(a.first_beam, b.first_beam);
  EXPECT_EQ(a.last_beam, b.last_beam);
}

void expectSame(const geometry::Arc& a, const geometry::Arc& b) {
  EXPECT_LT((a.centre - b.centre).norm(), 1e-5);
  EXPECT_NEAR(a.radius, b.radius, 1e-5);
  EXPECT_LT((a.covariance - b.covariance).norm(), 1e-3 * b.covariance.norm());
  EXPECT_NEAR(a.start_angle, b.start_angle, 1e-4);
  EXPECT_NEAR(a.end_angle, b.end_angle, 1e-4);
  EXPECT_EQ(a.first_beam, b.first_beam);
}

TEST(MirroredScan, HasTheMirroredLinesAndArcs) {
  test::Gauss gauss(4);
  test::ScanOf room = test::room();
  room.posts = {{{1.5, 0.8}, 0.2}, {{2.0, -1.0}, 0.1}};
  room.motion = {0.05, 0.02, 0.1};
  for (int run = 0; run < 20; ++run) {
    scan::Scan scan = room.take(gauss);
    scan.motion_noise.drift << 1e-5, 1e-6, 1e-6, 1e-6, 2e-5, 2e-6, 1e-6, 2e-6, 1e-5;
    scan.motion_noise.walk = 0.5 * scan.motion_noise.drift;
    scan.motion_noise.jitter = 1e-6;
    scan.motion_noise.jitter_axis = {0.1, 0.05};
    LineExtractor upright;
    LineExtractor hanging;
    const auto& segments = upright.extract(scan);
    const auto& others = hanging.extract(scan::mirrored(scan, scan.geometry()->mirrored()));
    ASSERT_EQ(segments.size(), others.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
      expectSame(geometry::mirrored(others[i]), segments[i]);
    }
    ASSERT_EQ(upright.arcs().size(), hanging.arcs().size());
    for (std::size_t i = 0; i < upright.arcs().size(); ++i) {
      expectSame(geometry::mirrored(hanging.arcs()[i]), upright.arcs()[i]);
    }
  }
}

}  // namespace
}  // namespace sightline::lines
