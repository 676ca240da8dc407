#include "sightline/mapping/pose_graph.h"

#include <gtest/gtest.h>

#include "sightline/mapping/path_adjuster.h"

namespace sightline::mapping {
namespace {

using geometry::Pose2;

// A square of 4 x 2.5 m driven once, as wheels that are 5 % short tell it.
std::vector<KeyScan> squareKeys() {
  std::vector<KeyScan> keys(1);
  for (int i = 1; i <= 40; ++i) {
    KeyScan key;
    const Pose2 step(0.25, 0.0, i % 10 == 0 ? 0.5 * geometry::kPi : 0.0);
    const Pose2 told(step.translation() / 1.05, step.theta());
    key.step.mean = told;
    key.step.covariance = Eigen::Vector3d(1e-3, 1e-4, 1e-4).asDiagonal();
    key.wheel_step = told;
    key.T_odom_base = keys.back().T_odom_base * told;
    key.way = 0.25 * i;
    keys.push_back(key);
  }
  return keys;
}

std::vector<Pose2> posesOfKeys(const std::vector<KeyScan>& keys) {
  std::vector<Pose2> poses;
  for (const KeyScan& key : keys) poses.push_back(key.T_odom_base);
  return poses;
}

Relation exact(std::size_t from, std::size_t to, const Pose2& motion) {
  return {from, to, motion, Eigen::Vector3d(1e4, 1e4, 1e5).asDiagonal(), true};
}

TEST(PoseGraph, LearnsTheScaleOfTheWheelsFromOneSide) {
  const auto keys = squareKeys();
  const auto solution =
      solvePoseGraph(keys, {exact(0, 9, Pose2(2.25, 0.0, 0.0))}, posesOfKeys(keys));
  // Held by what is expected of wheels, and by the noise of nine steps.
  EXPECT_NEAR(solution.wheel_scale, 1.05, 0.02);
  EXPECT_NEAR(solution.poses[9].x(), 2.25, 0.01);
  EXPECT_LT(solution.relation_cost.at(0), 1.0);
}

// Scans tell all of each step: the robot turns by 0.01 rad a metre, and its wheels tell nothing of
// it.
TEST(PoseGraph, LearnsHowTheWheelsTurnUnnoticed) {
  std::vector<KeyScan> keys(1);
  std::vector<Relation> relations;
  for (std::size_t i = 1; i <= 200; ++i) {
    KeyScan key;
    key.step.mean = {0.25, 0.0, 0.0025};
    key.wheel_step = Pose2(0.25, 0.0, 0.0);
    key.T_odom_base = keys.back().T_odom_base * key.step.mean;
    keys.push_back(key);
    relations.push_back(exact(i - 1, i, key.step.mean));
  }
  const auto solution = solvePoseGraph(keys, relations, posesOfKeys(keys));
  EXPECT_NEAR(solution.wheel_turn, 0.01, 0.002);
}

TEST(PoseGraph, AFalseLoopDoesNotBendThePath) {
  const auto keys = squareKeys();
  std::vector<Relation> relations;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const bool turns = i % 10 == 0;
    relations.push_back(exact(i - 1, i, Pose2(0.25, 0.0, turns ? 0.5 * geometry::kPi : 0.0)));
  }
  relations.push_back(exact(0, 25, Pose2(3.0, -4.0, 1.0)));
  const auto solution = solvePoseGraph(keys, relations, posesOfKeys(keys));
  EXPECT_NEAR(solution.poses.back().translation().norm(), 0.0, 0.02);
  EXPECT_GT(solution.relation_cost.back(), 100.0);
}

TEST(PoseGraph, KeepsWhatIsAlone) {
  const auto keys = squareKeys();
  const auto solution = solvePoseGraph(keys, {}, {Pose2(1.0, 2.0, 0.3)});
  ASSERT_EQ(solution.poses.size(), 1U);
  EXPECT_EQ(solution.poses[0].x(), 1.0);
}

TEST(PosesOf, GoThroughTheKeyScansAndBetweenThem) {
  const auto keys = squareKeys();
  std::vector<Pose2> adjusted;
  for (const KeyScan& key : keys) {
    adjusted.emplace_back(1.05 * key.T_odom_base.translation(), key.T_odom_base.theta());
  }
  const Pose2 halfway(keys[1].T_odom_base.translation() * 1.5, 0.0);
  const std::vector<PathPoint> path{{1, keys[1].T_odom_base, 1, {}, false},
                                    {2, halfway, 1, {}, false}};
  const auto poses = posesOf(path, keys, adjusted);
  EXPECT_NEAR(poses[0].pose.x(), adjusted[1].x(), 1e-9);
  EXPECT_NEAR(poses[1].pose.x(), 1.5 * adjusted[1].x(), 1e-6);
}

}  // namespace
}  // namespace sightline::mapping
