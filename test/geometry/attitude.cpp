#include "sightline/geometry/attitude.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "sightline/geometry/angle.h"

namespace sightline::geometry {
namespace {

TEST(Attitude, PositivePitchLooksDownAndPositiveRollLeansRight) {
  const double angle = radians(10.0);
  const Eigen::Vector3d ahead = Attitude{0.0, angle}.rotation() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(ahead.z(), -std::sin(angle), 1e-12);
  EXPECT_NEAR(ahead.x(), std::cos(angle), 1e-12);
  const Eigen::Vector3d left = Attitude{angle, 0.0}.rotation() * Eigen::Vector3d::UnitY();
  EXPECT_NEAR(left.z(), std::sin(angle), 1e-12);
}

TEST(Attitude, BodyAxisXKeepsTheHeadingWhateverTheRoll) {
  const Eigen::Vector3d ahead = Attitude{0.3, 0.2}.rotation() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(ahead.y(), 0.0, 1e-12);
  EXPECT_NEAR(ahead.z(), -std::sin(0.2), 1e-12);
}

TEST(Attitude, IsReadFromARotationWhateverItsHeading) {
  const Attitude attitude{-0.1, 0.2};
  for (const double heading : {0.0, 1.0, -2.5}) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Attitude read = Attitude::of(turn * attitude.rotation());
    EXPECT_NEAR(read.roll, attitude.roll, 1e-12);
    EXPECT_NEAR(read.pitch, attitude.pitch, 1e-12);
  }
}

TEST(Attitude, WhatNodsForTheBodyRollsForASensorThatLooksToTheSide) {
  const Attitude to_the_left = Attitude{0.0, 0.2}.seenFrom(0.5 * kPi);
  EXPECT_NEAR(to_the_left.roll, 0.2, 1e-12);
  EXPECT_NEAR(to_the_left.pitch, 0.0, 1e-12);
  const Attitude backwards = Attitude{0.1, 0.2}.seenFrom(kPi);
  EXPECT_NEAR(backwards.pitch, -0.2, 1e-12);
  EXPECT_NEAR(backwards.roll, -0.1, 1e-12);
}

}  // namespace
}  // namespace sightline::geometry
