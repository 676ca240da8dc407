#include "sightline/lines/wall_shape.h"

#include <cmath>

#include <gtest/gtest.h>

#include "monte_carlo.h"

namespace sightline::lines {
namespace {

using test::Gauss;

constexpr int kStepsPerMetre = 200;

// A random walk that goes on from part to part, with a diffusion of 1.
class RandomWalk {
 public:
  explicit RandomWalk(Gauss& gauss) : gauss_(gauss) {}

  double step() { return at_ += gauss_(std::sqrt(1.0 / kStepsPerMetre)); }
  void skip(double length) { at_ += gauss_(std::sqrt(length)); }

 private:
  Gauss& gauss_;
  double at_ = 0.0;
};

struct FittedPart {
  FittedPart(RandomWalk& walk, double from, double length) {
    const int count = static_cast<int>(length * kStepsPerMetre);
    double y = 0.0, xy = 0.0, xx = 0.0;
    middle = from + 0.5 * length;
    for (int i = 0; i < count; ++i) {
      const double x = from + (i + 0.5) / kStepsPerMetre - middle;
      const double w = walk.step();
      y += w;
      xy += x * w;
      xx += x * x;
    }
    mean = y / count;
    slope = xy / xx;
  }
  double at(double x) const { return mean + slope * (x - middle); }

  double middle;
  double mean;
  double slope;
};

TEST(WallShapeStatistics, DifferenceOfTwoPartsOfARandomWalk) {
  struct {
    double before, after, gap;
  } const cases[] = {{1.0, 1.0, 0.0}, {0.5, 2.0, 0.0}, {1.0, 0.4, 0.3}};
  Gauss gauss(61);
  for (const auto& of : cases) {
    constexpr int kWalks = 4000;
    Eigen::Vector2d squares(0, 0);
    for (int i = 0; i < kWalks; ++i) {
      RandomWalk walk(gauss);
      const FittedPart before(walk, 0.0, of.before);
      walk.skip(of.gap);
      const FittedPart after(walk, of.before + of.gap, of.after);
      const double between = of.before + 0.5 * of.gap;
      squares[0] += std::pow(before.at(between) - after.at(between), 2);
      squares[1] += std::pow(before.slope - after.slope, 2);
    }
    const Eigen::Vector2d expected = WallShape(1.0).difference(of.before, of.after, of.gap);
    EXPECT_NEAR(squares[0] / kWalks / expected[0], 1.0, 0.1) << of.before << ' ' << of.gap;
    EXPECT_NEAR(squares[1] / kWalks / expected[1], 1.0, 0.1) << of.before << ' ' << of.gap;
  }
}

TEST(WallShape, StraightWallsStrayByNothing) {
  EXPECT_TRUE(WallShape(0.0).difference(1.0, 2.0, 0.1).isZero(0.0));
  EXPECT_DOUBLE_EQ(WallShape(0.01).variance(4.0), 4e-4);
}

}  // namespace
}  // namespace sightline::lines
