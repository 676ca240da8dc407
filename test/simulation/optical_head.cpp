#include "sightline/simulation/optical_head.h"

#include <cmath>

#include <gtest/gtest.h>

#include "monte_carlo.h"
#include "sightline/simulation/detector.h"

namespace sightline::simulation {
namespace {

using geometry::Segment;
using triangulation::Intrinsics;

// A world of upright cards, white unless said otherwise.
class Cards {
 public:
  std::size_t add(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                  double reflectivity = 1.0) {
    const std::size_t material = world.addMaterial({"card", reflectivity});
    world.add(world::WorldSegment{Segment{from, to}, 0.0, 2.0, material});
    return material;
  }
  world::World world;
};

Eigen::Isometry3d upright(double x = 0.0, double y = 0.0) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, 1.0));
}

Optics thinBeam() {
  Optics optics;
  optics.rays = 1;
  return optics;
}

TEST(OpticalHead, CurrentFallsWithTheSquareOfTheRangeFromTheLens) {
  const Optics optics;
  const OpticalHead head(Intrinsics{}, optics);
  for (const double depth : {0.75, 1.5, 2.5}) {
    Cards cards;
    cards.add({depth, 2.0}, {depth, -2.0}, 0.6);
    const Eigen::Vector2d way = Eigen::Vector2d(depth, 0.0) - head.geometry().lens(0.0).centre;
    const double cosine = way.x() / way.norm();
    const double share = 0.25 * optics.lens_diameter * optics.lens_diameter / way.squaredNorm();
    const double expected = optics.laser_power * optics.responsivity * 0.6 * cosine * share;
    EXPECT_NEAR(head.look(cards.world, upright(), 0.0).current, expected, 1e-4 * expected);
  }
}

TEST(OpticalHead, ImageOfAThinBeamIsThatOfTheGeometry) {
  Cards cards;
  cards.add({1.0, 2.0}, {2.0, -2.0});
  const OpticalHead head(Intrinsics{}, thinBeam());
  for (const double angle : {-0.3, 0.0, 0.3}) {
    const double range =
        cards.world.cast({Eigen::Vector3d(0, 0, 1), {std::cos(angle), std::sin(angle), 0.0}})
            ->range;
    EXPECT_NEAR(head.look(cards.world, upright(), angle).image_position,
                head.geometry().imagePosition(range, angle), 1e-12);
  }
}

// The power of the rays sums to that of the laser, however many there are; on a flat target the
// width of the beam moves the image by far less than its noise.
TEST(OpticalHead, AWideBeamOnAFlatTargetLooksLikeAThinOne) {
  Cards cards;
  cards.add({1.2, 2.0}, {1.2, -2.0});
  const SpotImage thin = OpticalHead(Intrinsics{}, thinBeam()).look(cards.world, upright(), 0.2);
  const SpotImage wide = OpticalHead(Intrinsics{}, Optics{}).look(cards.world, upright(), 0.2);
  EXPECT_NEAR(wide.current, thin.current, 1e-5 * thin.current);
  EXPECT_NEAR(wide.image_position, thin.image_position, 0.05e-6);
  EXPECT_NE(wide.image_position, thin.image_position);
}

// Half of the beam on something near, half on something far: in between, as on a real detector.
TEST(OpticalHead, AtAnEdgeTheImageLiesBetween) {
  Cards cards;
  cards.add({1.0, 2.0}, {1.0, 0.0});  // away from the lens, which sees past it
  cards.add({2.0, 2.0}, {2.0, -2.0});
  const OpticalHead head(Intrinsics{}, Optics{});
  const SpotImage spot = head.look(cards.world, upright(), 0.0);
  const double near = head.geometry().imagePosition(1.0, 0.0);
  const double far = head.geometry().imagePosition(2.0, 0.0);
  EXPECT_LT(spot.image_position, near - 0.1 * (near - far));
  EXPECT_GT(spot.image_position, far + 0.1 * (near - far));
  // The nearer part counts for more.
  EXPECT_GT(spot.image_position, 0.5 * (near + far));
}

// The lens is 8.5 cm to the right: a post there hides from it what the laser still meets.
TEST(OpticalHead, WhatIsHiddenFromTheLensBringsNothing) {
  Cards cards;
  cards.add({2.0, 2.0}, {2.0, -2.0});
  const OpticalHead head(Intrinsics{}, Optics{});
  const double open = head.look(cards.world, upright(), 0.0).current;
  ASSERT_GT(open, 0.0);
  cards.add({1.0, -0.03}, {1.0, -0.06});  // midway between beam and lens
  EXPECT_EQ(head.look(cards.world, upright(), 0.0).current, 0.0);
  Cards discs;
  discs.add({2.0, 2.0}, {2.0, -2.0});
  discs.world.add(world::WorldDisc{{1.0, -0.045}, 0.02, 0.0, 2.0, 0});
  EXPECT_EQ(head.look(discs.world, upright(), 0.0).current, 0.0);
}

TEST(OpticalHead, TheLensSeesOnlyTheSideThatIsLit) {
  Cards cards;
  // The laser meets the upper side of a sloping card; the lens is below its line.
  cards.add({0.5, -0.01}, {3.0, 0.05});
  const SpotImage spot = OpticalHead(Intrinsics{}, thinBeam()).look(cards.world, upright(), 0.0);
  EXPECT_EQ(spot.current, 0.0);
}

TEST(OpticalHead, LightBesideTheDetectorIsLost) {
  Cards cards;
  cards.add({0.2, 1.0}, {0.2, -1.0});
  EXPECT_EQ(OpticalHead(Intrinsics{}, Optics{}).look(cards.world, upright(), 0.0).current, 0.0);
}

TEST(OpticalHead, EmptySpaceIsDark) {
  EXPECT_EQ(OpticalHead(Intrinsics{}, Optics{}).look(world::World(), upright(), 0.0).current, 0.0);
}

// pears eq. 2.
TEST(Detector, NoiseOfTheImagePositionIsThatOfTheCurrent) {
  Detector detector(36.22e-12, 0.01, 0.0, 2500.0, 3);
  test::Moments<2> moments;  // of position and its neighbour
  double before = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const double p = triangulation::imagePosition(detector.measure({10e-9, 1e-3}), 0.01);
    if (i > 0) moments.add({p, before});
    before = p;
  }
  const double sigma = 18.11e-6;
  EXPECT_NEAR(moments.mean()[0], 1e-3, 4.0 * sigma / 200.0);
  EXPECT_NEAR(std::sqrt(moments.covariance()(0, 0)), sigma, 0.02 * sigma);
  EXPECT_NEAR(moments.covariance()(0, 1) / (sigma * sigma), 0.0, 0.02);
}

// 1 kHz at 2.5 kHz: exp(-2 pi / 2.5) = 0.081.
TEST(Detector, ABandwidthMakesNeighboursAlike) {
  Detector detector(36.22e-12, 0.01, 1000.0, 2500.0, 3);
  test::Moments<2> moments;
  double before = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const double p = triangulation::imagePosition(detector.measure({10e-9, 1e-3}), 0.01);
    if (i > 0) moments.add({p, before});
    before = p;
  }
  const double sigma = 18.11e-6;
  EXPECT_NEAR(std::sqrt(moments.covariance()(0, 0)), sigma, 0.02 * sigma);
  EXPECT_NEAR(moments.covariance()(0, 1) / moments.covariance()(0, 0), 0.081, 0.02);
  // Light is late by the same share.
  EXPECT_NEAR(detector.measure({0.0, 0.0}).total(), 0.081 * 10e-9, 4.0 * 0.03622e-9);
}

}  // namespace
}  // namespace sightline::simulation
