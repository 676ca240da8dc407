#include "sightline/tracking/range_weighted_hough.h"

#include <deque>

#include <gtest/gtest.h>

namespace sightline::tracking {
namespace {

using geometry::Pose2;

// Two walls of a room, seen by a robot that stands and looks a little otherwise than it believes.
class TwoWalls : public ::testing::Test {
 protected:
  TwoWalls() {
    north_.segment = {{4.0, 2.0}, {-4.0, 2.0}};
    north_.spans = {{0.0, 8.0}};
    east_.segment = {{4.0, -2.0}, {4.0, 2.0}};
    east_.spans = {{0.0, 4.0}};
    believed_.covariance.diagonal() << 0.01, 0.01, 0.005;
  }

  GatedWall gatedWall(const world::Wall& wall) const {
    return {ValidationGate({}, wall, 0.01, believed_, 0.01), {}};
  }

  void see(GatedWall& wall, const Eigen::Vector2d& point_map) {
    BeamPoint point;
    point.position = truth_.inverse() * point_map;
    point.range = point.position.norm();
    points_.push_back(point);
    wall.points.push_back(&points_.back());
  }

  void seeWalls(GatedWall& north, GatedWall& east) {
    for (double s = -1.5; s <= 1.5; s += 0.05) {
      see(north, {s, 2.0});
      see(east, {4.0, s});
    }
  }

  Pose2 truth_{0.06, -0.08, 0.05};
  geometry::UncertainPose2 believed_;
  world::Wall north_;
  world::Wall east_;
  std::deque<BeamPoint> points_;
};

TEST_F(TwoWalls, OneTurnAndEveryWallsDistance) {
  std::vector<GatedWall> walls{gatedWall(north_), gatedWall(east_)};
  seeWalls(walls[0], walls[1]);
  const HoughConfig config;
  const HoughPeaks peaks = RangeWeightedHough(config).transform(walls);
  EXPECT_NEAR(peaks.turn, -0.05, config.angle_bin);
  ASSERT_FALSE(peaks.walls[0].empty() || peaks.walls[1].empty());
  EXPECT_NEAR(peaks.walls[0].front().distance, 0.08, config.distance_bin);
  EXPECT_NEAR(peaks.walls[1].front().distance, -0.06, config.distance_bin);
}

TEST_F(TwoWalls, FarBeamsOutweighManyNearOnes) {
  std::vector<GatedWall> walls{gatedWall(north_)};
  truth_ = Pose2();
  // Thirty beams on a shelf close by, fifteen on the wall five times as far.
  for (int i = 0; i < 30; ++i) see(walls[0], {0.4 + 0.005 * i, 1.75});
  for (double s = 3.0; s <= 4.0; s += 0.07) see(walls[0], {s, 2.0});
  for (BeamPoint& point : points_) point.range = point.position.x() > 1.0 ? 5.0 : 1.0;
  const HoughPeaks peaks = RangeWeightedHough({}).transform(walls);
  ASSERT_FALSE(peaks.walls[0].empty());
  EXPECT_NEAR(peaks.walls[0].front().distance, 0.0, 0.05);
}

TEST_F(TwoWalls, NoBeamsNoPeak) {
  const HoughPeaks peaks = RangeWeightedHough({}).transform({gatedWall(north_), gatedWall(east_)});
  ASSERT_EQ(peaks.walls.size(), 2U);
  EXPECT_TRUE(peaks.walls[0].empty() && peaks.walls[1].empty());
  EXPECT_EQ(peaks.turn, 0.0);
}

TEST_F(TwoWalls, OneWallAlone) {
  GatedWall north = gatedWall(north_);
  GatedWall east = gatedWall(east_);
  seeWalls(north, east);
  const HoughConfig config;
  const auto peak = RangeWeightedHough(config).heaviest(north);
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->turn, -0.05, config.angle_bin);
  EXPECT_NEAR(peak->distance, 0.08, config.distance_bin);
  EXPECT_FALSE(RangeWeightedHough(config).heaviest(gatedWall(north_)));
}

// The finest bins in the widest gates that settings can ask for: the search stays small, the bins
// get wider, and the walls are still found to a bin.
TEST_F(TwoWalls, BinsAreBoundedWhateverIsAskedFor) {
  GateConfig gate;
  gate.sigmas = 10.0;
  gate.max_opening = 10.0;
  gate.max_angle = 1.5;
  believed_.covariance.diagonal() << 4.0, 4.0, 1.0;
  std::vector<GatedWall> walls;
  for (const world::Wall* wall : {&north_, &east_}) {
    walls.push_back({ValidationGate(gate, *wall, 0.01, believed_, 0.01), {}});
  }
  seeWalls(walls[0], walls[1]);
  HoughConfig finest;
  finest.distance_bin = 1e-3;
  finest.angle_bin = 1e-4;
  const HoughPeaks peaks = RangeWeightedHough(finest).transform(walls);
  ASSERT_FALSE(peaks.walls[0].empty() || peaks.walls[1].empty());
  EXPECT_DOUBLE_EQ(peaks.walls[0].front().distance_bin, walls[0].gate.size().opening / 100.0);
  EXPECT_DOUBLE_EQ(peaks.walls[0].front().turn_bin, walls[0].gate.size().angle / 100.0);
  EXPECT_NEAR(peaks.turn, -0.05, peaks.walls[0].front().turn_bin);
  EXPECT_NEAR(peaks.walls[1].front().distance, -0.06, peaks.walls[1].front().distance_bin);
}

}  // namespace
}  // namespace sightline::tracking
