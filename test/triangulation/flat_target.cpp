#include "sightline/triangulation/flat_target.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sightline::triangulation {
namespace {

TEST(FlatTarget, PowerBeyondAnEdgeIsThatOfACutGaussian) {
  const double width = 0.003;
  EXPECT_EQ(powerBeyond(-0.0016, width), 0.0);
  EXPECT_EQ(powerBeyond(0.0016, width), 1.0);
  EXPECT_EQ(powerBeyond(0.0, width), 0.5);
  EXPECT_NEAR(powerBeyond(-0.0005, width) + powerBeyond(0.0005, width), 1.0, 1e-12);
  double below = 0.0;
  double all = 0.0;
  for (double u = -0.0015; u < 0.0015; u += 1e-7) {
    const double density = std::exp(-8.0 * u * u / (width * width));
    all += density;
    if (u < 0.0006) below += density;
  }
  EXPECT_NEAR(powerBeyond(0.0006, width), below / all, 1e-4);
  EXPECT_EQ(powerBeyond(1e-9, 0.0), 1.0);
}

// The spot of many rays, each to its own image.
double centroidShift(const ProjectionGeometry& geometry, double depth, double angle, double width) {
  const auto lens = geometry.lens(angle);
  double light = 0.0;
  double moment = 0.0;
  for (double offset = -0.5 * width; offset <= 0.5 * width; offset += 1e-3 * width) {
    const Eigen::Vector2d spot(depth, (depth * std::sin(angle) + offset) / std::cos(angle));
    const Eigen::Vector2d way = spot - lens.centre;
    const double cosine = way.x() / way.norm();
    const double current =
        std::exp(-8.0 * std::pow(offset / width, 2)) * cosine / way.squaredNorm();
    light += current;
    moment += current * geometry.imagePosition(spot, lens);
  }
  return moment / light - geometry.imagePosition(depth / std::cos(angle), angle);
}

TEST(FlatTarget, SpotShiftsTheImageToSecondOrder) {
  const ProjectionGeometry geometry{Intrinsics()};
  for (const double depth : {0.3, 0.8, 2.5}) {
    for (const double angle : {-0.35, 0.0, 0.35}) {
      const double expected = centroidShift(geometry, depth, angle, 0.003);
      const SpotOnTarget spot = spotOnTarget(geometry, depth, angle, 0.003);
      EXPECT_NEAR(spot.shift, expected, 0.01 * std::abs(expected) + 1e-11) << depth << " " << angle;
      const SpotOnTarget doubled = spotOnTarget(geometry, depth, angle, 0.006);
      EXPECT_NEAR(doubled.shift, 4.0 * spot.shift, 0.1 * std::abs(spot.shift) + 1e-11);
      EXPECT_NEAR(spot.half_length, 0.050 * 0.0015 / depth, 0.5 * 0.050 * 0.0015 / depth);
    }
  }
  EXPECT_EQ(spotOnTarget(geometry, 1.0, 0.1, 0.0).shift, 0.0);
}

}  // namespace
}  // namespace sightline::triangulation
