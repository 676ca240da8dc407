#include "sightline/dead_reckoning/submap_matcher.h"

#include <cmath>

#include <gtest/gtest.h>

#include "dead_reckoning/simulated_scans.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;
using geometry::UncertainPose2;

/// A matcher whose reference is the furnished room, seen from its middle.
class SubmapMatcherInRoom : public testing::Test {
 protected:
  SubmapMatcherInRoom() { matcher_.learn(lookFrom(room_, {}), {}, {}); }

  static SurfaceScan lookFrom(test::Viewer& viewer, const Pose2& pose) {
    return readSurfaces(viewer.look(pose, 0.0), Pose2(), Eigen::Vector3d::Zero());
  }

  MatchOutcome match(const SurfaceScan& surfaces, const Pose2& predicted) const {
    return matcher_.match(surfaces, {predicted, 0.01 * Eigen::Matrix3d::Identity()},
                          {predicted, 0.3, 0.3});
  }

  /// One scan of another place, which nothing prepared for, is matched and learned.
  MatchOutcome takeElsewhere(const Pose2& pose) {
    const SurfaceScan surfaces = lookFrom(elsewhere_, pose);
    const MatchOutcome outcome = match(surfaces, pose);
    matcher_.learn(surfaces, pose, outcome);
    return outcome;
  }

  test::Viewer room_{test::furnishedRoom(), test::scanner(), 3};
  test::Viewer elsewhere_{test::squareRoom(), test::scanner(), 4};
  SubmapMatcher matcher_{SubmapConfig()};
};

void expectNear(const Pose2& estimate, const Pose2& truth) {
  const Pose2 error = geometry::between(truth, estimate);
  EXPECT_LT(error.translation().norm(), 0.02);
  EXPECT_LT(std::abs(error.theta()), 0.01);
}

TEST_F(SubmapMatcherInRoom, TakesAClearLocalMatchWithoutSearching) {
  const Pose2 pose(0.1, -0.05, 0.08);
  const MatchOutcome outcome = match(lookFrom(room_, pose), {});
  EXPECT_EQ(outcome.state, MatchState::kMatched);
  EXPECT_EQ(outcome.evaluations, 1U);
  expectNear(outcome.T_odom_base, pose);
}

TEST_F(SubmapMatcherInRoom, SearchesAWideWindow) {
  const Pose2 pose(0.9, -0.6, 0.7);
  const UncertainPose2 vague{{}, Eigen::Matrix3d::Identity()};
  const MatchOutcome outcome = matcher_.match(lookFrom(room_, pose), vague, {Pose2(), 1.2, 1.0});
  EXPECT_EQ(outcome.state, MatchState::kMatched);
  EXPECT_GT(outcome.evaluations, 1000U);
  expectNear(outcome.T_odom_base, pose);
}

TEST_F(SubmapMatcherInRoom, AddsAKeyframeWhenItHasGoneFarEnough) {
  const SubmapConfig config;
  const Pose2 near(0.5 * config.spacing, 0.0, 0.0);
  const SurfaceScan from_near = lookFrom(room_, near);
  EXPECT_EQ(matcher_.learn(from_near, near, match(from_near, near)), 0.0);
  const Pose2 turned(0.0, 0.0, 2.0);
  const SurfaceScan from_turned = lookFrom(room_, turned);
  MatchOutcome matched;
  matched.state = MatchState::kMatched;
  const double share_new = matcher_.learn(from_turned, turned, matched);
  EXPECT_GT(share_new, 0.3);
  EXPECT_LT(share_new, 1.0);
}

TEST_F(SubmapMatcherInRoom, AScanThatFitsNowhereBeginsAFreshReference) {
  EXPECT_EQ(takeElsewhere({}).state, MatchState::kFailed);
  const MatchOutcome next = takeElsewhere({0.05, 0.0, 0.0});
  EXPECT_EQ(next.state, MatchState::kMatched);
  EXPECT_TRUE(next.reference.is_fresh);
  expectNear(next.T_odom_base, {0.05, 0.0, 0.0});
}

TEST_F(SubmapMatcherInRoom, TheFirstReferenceComesBackWhereItFitsAgain) {
  takeElsewhere({});
  takeElsewhere({0.05, 0.0, 0.0});
  const SurfaceScan surfaces = lookFrom(room_, {0.1, 0.0, 0.0});
  const MatchOutcome back = match(surfaces, {0.1, 0.0, 0.0});
  EXPECT_FALSE(back.reference.is_fresh);
  EXPECT_EQ(back.state, MatchState::kMatched);
  matcher_.learn(surfaces, {0.1, 0.0, 0.0}, back);
  // The fresh one is forgotten.
  EXPECT_EQ(takeElsewhere({}).state, MatchState::kFailed);
}

TEST_F(SubmapMatcherInRoom, AFewScansThatFitTheFreshReferenceAloneMakeItTheOne) {
  takeElsewhere({});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(takeElsewhere({}).reference.is_fresh);
  const MatchOutcome trusted = takeElsewhere({});
  EXPECT_FALSE(trusted.reference.is_fresh);
  EXPECT_EQ(trusted.state, MatchState::kMatched);
  EXPECT_EQ(match(lookFrom(room_, {}), {}).state, MatchState::kFailed);
}

TEST_F(SubmapMatcherInRoom, APoseThatJumpsAfterABridgeIsRecovered) {
  takeElsewhere({});
  // The prediction has gone astray by far more than it says.
  const Pose2 truth(0.0, 0.1, 0.0);
  const SurfaceScan surfaces = lookFrom(room_, truth);
  const UncertainPose2 astray{{0.28, 0.1, 0.0}, 0.1 * Eigen::Matrix3d::Identity()};
  const MatchOutcome outcome = matcher_.match(surfaces, astray, {astray.mean, 0.3, 0.3});
  EXPECT_EQ(outcome.state, MatchState::kRecovered);
  expectNear(outcome.T_odom_base, truth);
}

TEST_F(SubmapMatcherInRoom, FewPointsAreNoMatch) {
  SurfaceScan few = lookFrom(room_, {});
  few.points.resize(10);
  const MatchOutcome outcome = match(few, {});
  EXPECT_EQ(outcome.state, MatchState::kFailed);
  EXPECT_EQ(matcher_.learn(few, {}, outcome), 0.0);
}

TEST_F(SubmapMatcherInRoom, ClearForgetsTheReference) {
  EXPECT_TRUE(matcher_.hasReference());
  matcher_.clear();
  EXPECT_FALSE(matcher_.hasReference());
}

TEST(Submap, TakesOutAScanThatWasPutInAtAWrongPose) {
  test::Viewer viewer(test::furnishedRoom(), test::scanner(), 3);
  const auto surfacesAt = [&](const Pose2& pose) {
    return readSurfaces(viewer.look(pose, 0.0), Pose2(), Eigen::Vector3d::Zero());
  };
  Submap submap;
  submap.add({}, surfacesAt({}), 20);
  const Pose2 wrong(0.5, 0.9, 0.4);
  submap.add(wrong, surfacesAt({0.4, 0.0, 0.0}), 20);
  EXPECT_EQ(submap.keyframes().size(), 2U);  // One against one: none is known to be wrong.
  for (const double x : {0.8, 1.2}) submap.add({x, 0.0, 0.1}, surfacesAt({x, 0.0, 0.1}), 20);
  ASSERT_EQ(submap.keyframes().size(), 3U);
  for (const Keyframe& keyframe : submap.keyframes()) {
    EXPECT_GT((keyframe.T_odom_base.translation() - wrong.translation()).norm(), 0.1);
  }
}

TEST(Submap, RefusesAScanThatTwoOthersContradict) {
  test::Viewer viewer(test::furnishedRoom(), test::scanner(), 4);
  const auto surfacesAt = [&](const Pose2& pose) {
    return readSurfaces(viewer.look(pose, 0.0), Pose2(), Eigen::Vector3d::Zero());
  };
  Submap submap;
  for (const double x : {0.0, 0.4, 0.8}) submap.add({x, 0.0, 0.0}, surfacesAt({x, 0.0, 0.0}), 20);
  EXPECT_EQ(submap.add({0.9, 0.9, 0.4}, surfacesAt({1.2, 0.0, 0.0}), 20), 0.0);
  EXPECT_EQ(submap.keyframes().size(), 3U);
}

}  // namespace
}  // namespace sightline::dead_reckoning
