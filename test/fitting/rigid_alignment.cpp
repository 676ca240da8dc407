#include "sightline/fitting/rigid_alignment.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace sightline::fitting {
namespace {

using geometry::Pose2;

double sumOfSquares(const std::vector<PointPair>& pairs, const Pose2& pose) {
  double sum = 0.0;
  for (const PointPair& pair : pairs) sum += (pair.target - pose * pair.source).squaredNorm();
  return sum;
}

std::vector<PointPair> noisyPairs(const Pose2& pose, double sigma, std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  std::normal_distribution<double> noise(0.0, sigma);
  std::vector<PointPair> pairs;
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector2d source(place(random), place(random));
    pairs.push_back({pose * source + Eigen::Vector2d(noise(random), noise(random)), source});
  }
  return pairs;
}

TEST(RigidAlignment, RecoversAMotionExactly) {
  std::mt19937_64 random(1);
  for (const Pose2& pose : {Pose2(1.0, -2.0, 0.5), Pose2(0.0, 0.0, 3.1), Pose2(-4.0, 7.0, -2.0)}) {
    const auto aligned = alignPoints(noisyPairs(pose, 0.0, random));
    ASSERT_TRUE(aligned);
    EXPECT_LT(geometry::between(pose, *aligned).log().norm(), 1e-9);
  }
}

// No pose about the closed form, searched by brute force, leaves less.
TEST(RigidAlignment, IsTheLeastSquares) {
  std::mt19937_64 random(2);
  const auto pairs = noisyPairs({0.3, 0.4, 0.9}, 0.2, random);
  const auto aligned = alignPoints(pairs);
  ASSERT_TRUE(aligned);
  const double least = sumOfSquares(pairs, *aligned);
  constexpr double kStep = 0.002;
  for (int x = -10; x <= 10; ++x) {
    for (int y = -10; y <= 10; ++y) {
      for (int t = -10; t <= 10; ++t) {
        const Eigen::Vector3d off = kStep * Eigen::Vector3d(x, y, t);
        EXPECT_GE(sumOfSquares(pairs, Pose2(aligned->coordinates() + off)), least - 1e-9);
      }
    }
  }
}

TEST(RigidAlignment, NeedsTwoPlaces) {
  EXPECT_FALSE(alignPoints({}));
  EXPECT_FALSE(alignPoints({{{1.0, 1.0}, {2.0, 2.0}}}));
  EXPECT_FALSE(alignPoints({{{1.0, 1.0}, {2.0, 2.0}}, {{1.0, 1.0}, {2.0, 2.0}}}));
}

}  // namespace
}  // namespace sightline::fitting
