#include "sightline/motion/pose_history.h"

#include <limits>

#include <gtest/gtest.h>

namespace sightline::motion {
namespace {

using geometry::Pose2;

constexpr std::int64_t kSecond = 1'000'000'000;

PoseHistory drive() {
  PoseHistory history;
  history.add(10 * kSecond, Pose2(0.0, 0.0, 0.0));
  history.add(11 * kSecond, Pose2(1.0, 1.0, 0.5 * geometry::kPi));
  history.add(12 * kSecond, Pose2(1.0, 2.0, 0.5 * geometry::kPi));
  return history;
}

void expectAt(const PoseHistory& history, std::int64_t stamp, const Pose2& expected) {
  const auto pose = history.at(stamp);
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->coordinates() - expected.coordinates()).norm(), 1e-12);
}

TEST(PoseHistory, IsEmptyAtFirst) {
  const PoseHistory history;
  EXPECT_TRUE(history.empty());
  EXPECT_FALSE(history.at(0));
}

TEST(PoseHistory, GivesBackWhatItWasGiven) {
  const PoseHistory history = drive();
  EXPECT_EQ(history.oldest(), 10 * kSecond);
  EXPECT_EQ(history.newest(), 12 * kSecond);
  expectAt(history, 10 * kSecond, {0.0, 0.0, 0.0});
  expectAt(history, 11 * kSecond, {1.0, 1.0, 0.5 * geometry::kPi});
  expectAt(history, 12 * kSecond, {1.0, 2.0, 0.5 * geometry::kPi});
}

TEST(PoseHistory, InterpolatesAlongTheArcDriven) {
  const PoseHistory history = drive();
  const double part = std::sqrt(0.5);
  expectAt(history, 10 * kSecond + kSecond / 2, {part, 1.0 - part, 0.25 * geometry::kPi});
  expectAt(history, 11 * kSecond + kSecond / 4, {1.0, 1.25, 0.5 * geometry::kPi});
}

TEST(PoseHistory, NeverExtrapolates) {
  const PoseHistory history = drive();
  EXPECT_FALSE(history.at(10 * kSecond - 1));
  EXPECT_FALSE(history.at(12 * kSecond + 1));
  EXPECT_FALSE(history.at(0));
  EXPECT_FALSE(history.at(std::numeric_limits<std::int64_t>::max()));
}

TEST(PoseHistory, StartsAnewWhenTheClockIsSetBack) {
  PoseHistory history = drive();
  history.add(5 * kSecond, Pose2(7.0, 0.0, 0.0));
  EXPECT_EQ(history.oldest(), 5 * kSecond);
  EXPECT_EQ(history.newest(), 5 * kSecond);
  EXPECT_FALSE(history.at(11 * kSecond));
  expectAt(history, 5 * kSecond, {7.0, 0.0, 0.0});
}

TEST(PoseHistory, ReplacesThePoseOfARepeatedStamp) {
  PoseHistory history = drive();
  history.add(12 * kSecond, Pose2(1.0, 3.0, 0.5 * geometry::kPi));
  EXPECT_EQ(history.oldest(), 10 * kSecond);
  expectAt(history, 12 * kSecond, {1.0, 3.0, 0.5 * geometry::kPi});
  expectAt(history, 11 * kSecond + kSecond / 2, {1.0, 2.0, 0.5 * geometry::kPi});
}

TEST(PoseHistory, KeepsNoMoreThanItsLength) {
  PoseHistory history(2 * kSecond);
  for (int i = 0; i <= 100; ++i) history.add(i * kSecond / 10, Pose2(0.1 * i, 0.0, 0.0));
  EXPECT_EQ(history.newest(), 10 * kSecond);
  EXPECT_LE(history.oldest(), 8 * kSecond);
  EXPECT_GE(history.oldest(), 8 * kSecond - kSecond / 10);
  expectAt(history, 8 * kSecond + kSecond / 20, {8.05, 0.0, 0.0});
}

TEST(PoseHistory, KeepsTwoPosesHoweverFarApart) {
  PoseHistory history(kSecond);
  history.add(0, Pose2());
  history.add(100 * kSecond, Pose2(10.0, 0.0, 0.0));
  expectAt(history, 50 * kSecond, {5.0, 0.0, 0.0});
}

TEST(PoseHistory, IsEmptyOnceCleared) {
  PoseHistory history = drive();
  history.clear();
  EXPECT_TRUE(history.empty());
  EXPECT_FALSE(history.at(11 * kSecond));
}

}  // namespace
}  // namespace sightline::motion
