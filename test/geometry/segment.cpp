#include "sightline/geometry/segment.h"

#include <gtest/gtest.h>

namespace sightline::geometry {
namespace {

using Eigen::Vector2d;

const Segment kNorth{{4.0, 3.0}, {1.0, 3.0}};  // runs west

TEST(Segment, KnowsItsShape) {
  EXPECT_DOUBLE_EQ(kNorth.length(), 3.0);
  EXPECT_LT((kNorth.midpoint() - Vector2d(2.5, 3.0)).norm(), 1e-15);
  EXPECT_LT((kNorth.direction() - Vector2d(-1.0, 0.0)).norm(), 1e-15);
}

TEST(Segment, HasTheInsideOfACounterClockwiseRoomOnItsLeft) {
  EXPECT_LT((kNorth.leftNormal() - Vector2d(0.0, -1.0)).norm(), 1e-15);
}

TEST(Segment, LiesOnItsLine) {
  const PolarLine line = kNorth.line();
  EXPECT_NEAR(line.rho, 3.0, 1e-15);
  EXPECT_NEAR(line.phi, 0.5 * kPi, 1e-15);
  const PolarLine beyond = Segment{{-1.0, -2.0}, {-2.0, -1.0}}.line();
  EXPECT_NEAR(beyond.rho, 3.0 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(beyond.phi, -0.75 * kPi, 1e-15);
}

TEST(Segment, MeasuresToItsNearestPoint) {
  EXPECT_DOUBLE_EQ(kNorth.distance({2.0, 5.0}), 2.0);
  EXPECT_DOUBLE_EQ(kNorth.distance({2.0, 1.0}), 2.0);
  EXPECT_DOUBLE_EQ(kNorth.distance({8.0, 6.0}), 5.0);
  EXPECT_DOUBLE_EQ(kNorth.distance({-3.0, 0.0}), 5.0);
}

TEST(Segment, MeasuresAlongItself) {
  EXPECT_DOUBLE_EQ(kNorth.along({3.0, 7.0}), 1.0);
  EXPECT_DOUBLE_EQ(kNorth.along({5.0, 3.0}), -1.0);
  EXPECT_DOUBLE_EQ(kNorth.along({0.0, 3.0}), 4.0);
}

TEST(Segment, OfNoLengthIsAPoint) {
  const Segment point{{1.0, 2.0}, {1.0, 2.0}};
  EXPECT_DOUBLE_EQ(point.distance({4.0, 6.0}), 5.0);
  EXPECT_EQ(point.length(), 0.0);
}

TEST(Segment, MovesWithItsFrame) {
  const Pose2 T(1.0, -2.0, 0.7);
  const Segment moved = T * kNorth;
  EXPECT_LT((moved.start - T * kNorth.start).norm(), 1e-15);
  EXPECT_LT((moved.end - T * kNorth.end).norm(), 1e-15);
  EXPECT_LT(difference(moved.line(), transform(T, kNorth.line())).norm(), 1e-14);
}

}  // namespace
}  // namespace sightline::geometry
