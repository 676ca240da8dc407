#include "sightline/dead_reckoning/motion_habit.h"

#include <gtest/gtest.h>

namespace sightline::dead_reckoning {
namespace {

TEST(MotionHabit, LearnsNothingOfWhatIsNotMeasured) {
  MotionHabit habit({});
  const CarrierConfig before = habit.expected();
  const Eigen::Vector3d calm(0.5, 0.0, 0.0);
  const Eigen::Vector3d wild(3.0, 0.0, 2.0);
  for (int i = 0; i < 50; ++i) {
    habit.learn(calm, calm, 0.2, Eigen::Vector2d::Zero());
    habit.learn(calm, wild, 0.2, Eigen::Vector2d::Zero());
  }
  EXPECT_DOUBLE_EQ(habit.expected().acceleration, before.acceleration);
  EXPECT_DOUBLE_EQ(habit.expected().turn_acceleration, before.turn_acceleration);
  for (int i = 0; i < 50; ++i) habit.learn(calm, calm, 0.2);
  EXPECT_LT(habit.expected().acceleration, 0.7 * before.acceleration);
  habit.learn(calm, wild, 0.2);
  EXPECT_GT(habit.expected().acceleration, 2.0 * before.acceleration);
}

}  // namespace
}  // namespace sightline::dead_reckoning
