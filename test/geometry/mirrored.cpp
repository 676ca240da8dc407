#include <gtest/gtest.h>

#include "sightline/geometry/arc.h"
#include "sightline/geometry/line_segment.h"

namespace sightline::geometry {
namespace {

TEST(Mirrored, SegmentIsOnTheOtherSideOfTheXAxis) {
  LineSegment segment;
  segment.line = {2.0, 0.5, (Eigen::Matrix2d() << 4.0, 0.3, 0.3, 1.0).finished()};
  segment.ends = {{1.0, 2.0}, {2.0, -0.5}};
  segment.start_sigma = 0.1;
  segment.start_kind = EndKind::kOccluded;
  segment.first_beam = 3;
  segment.last_beam = 9;
  const LineSegment other = mirrored(segment);
  EXPECT_DOUBLE_EQ(other.line.rho, 2.0);
  EXPECT_DOUBLE_EQ(other.line.phi, -0.5);
  EXPECT_DOUBLE_EQ(other.line.covariance(0, 1), -0.3);
  EXPECT_DOUBLE_EQ(other.line.covariance(1, 0), -0.3);
  EXPECT_DOUBLE_EQ(other.line.covariance(0, 0), 4.0);
  EXPECT_EQ(other.ends.start, Eigen::Vector2d(1.0, -2.0));
  EXPECT_EQ(other.ends.end, Eigen::Vector2d(2.0, 0.5));
  EXPECT_EQ(other.start_sigma, 0.1);
  EXPECT_EQ(other.start_kind, EndKind::kOccluded);
  EXPECT_EQ(other.first_beam, 3u);
  EXPECT_EQ(other.last_beam, 9u);
}

TEST(Mirrored, AnglesStayInTheirRanges) {
  LineSegment segment;
  segment.line.phi = kPi;
  EXPECT_DOUBLE_EQ(mirrored(segment).line.phi, kPi);
  Arc arc;
  arc.start_angle = 3.0;
  arc.end_angle = 4.0;
  const Arc other = mirrored(arc);
  EXPECT_NEAR(other.start_angle, 2.0 * kPi - 4.0, 1e-12);
  EXPECT_NEAR(other.end_angle, 2.0 * kPi - 3.0, 1e-12);
}

TEST(Mirrored, ArcTwiceIsItself) {
  Arc arc;
  arc.centre = {1.0, 0.7};
  arc.radius = 0.4;
  arc.covariance << 3.0, 0.1, 0.2, 0.1, 2.0, 0.3, 0.2, 0.3, 1.0;
  arc.start_angle = -2.0;
  arc.end_angle = 0.5;
  arc.beams = 12;
  EXPECT_DOUBLE_EQ(mirrored(arc).centre.y(), -0.7);
  EXPECT_DOUBLE_EQ(mirrored(arc).covariance(0, 1), -0.1);
  EXPECT_DOUBLE_EQ(mirrored(arc).covariance(1, 2), -0.3);
  EXPECT_DOUBLE_EQ(mirrored(arc).covariance(0, 2), 0.2);
  const Arc twice = mirrored(mirrored(arc));
  EXPECT_EQ(twice.centre, arc.centre);
  EXPECT_EQ(twice.covariance, arc.covariance);
  EXPECT_NEAR(twice.start_angle, arc.start_angle, 1e-12);
  EXPECT_NEAR(twice.end_angle, arc.end_angle, 1e-12);
  EXPECT_EQ(twice.beams, 12u);
}

}  // namespace
}  // namespace sightline::geometry
