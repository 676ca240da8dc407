#include <stdexcept>

#include <gtest/gtest.h>

#include "dead_reckoning/simulated_scans.h"
#include "sightline/dead_reckoning/dead_reckoner.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;

constexpr double kBetween = 0.2;  // scans [s]

Pose2 places(int scan) {
  return Pose2(-1.5, 0.5, 0.0) * Pose2::exp(scan * Eigen::Vector3d(0.08, 0.0, 0.05));
}

class MatchAndCommit : public testing::TestWithParam<Method> {};

TEST_P(MatchAndCommit, AMatchChangesNothingUntilItIsCommitted) {
  DeadReckonerConfig config;
  config.method = GetParam();
  DeadReckoner tried(config);
  DeadReckoner straight(config);
  test::Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  for (int i = 0; i <= 6; ++i) {
    const scan::Scan scan = viewer.look(places(i), kBetween * i);
    // Another scan is tried and thrown away.
    tried.match(viewer.look(places(i + 3), kBetween * i), Pose2());
    const auto match = tried.match(scan, Pose2());
    ASSERT_TRUE(match);
    const auto update = tried.commit(*match);
    const auto expected = straight.update(scan, Pose2());
    EXPECT_EQ(update.pose.mean.coordinates(), expected->pose.mean.coordinates());
    EXPECT_EQ(update.pose.mean.coordinates(), match->T_odom_base.coordinates());
    EXPECT_EQ(update.pose.covariance, expected->pose.covariance);
    EXPECT_EQ(update.step.covariance, expected->step.covariance);
    EXPECT_EQ(update.state, expected->state);
  }
}

TEST(MatchAndCommitOnce, AMatchMadeBeforeTheLastChangeIsRefused) {
  DeadReckoner reckoner({});
  test::Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  const auto first = reckoner.match(viewer.look(places(0), 0.0), Pose2());
  reckoner.commit(*first);
  EXPECT_THROW(reckoner.commit(*first), std::invalid_argument);
  const auto second = reckoner.match(viewer.look(places(1), kBetween), Pose2());
  reckoner.restartClock();
  EXPECT_THROW(reckoner.commit(*second), std::invalid_argument);
}

TEST(MatchAndCommitOnce, AScanWithoutBeamsIsBridged) {
  DeadReckoner reckoner({});
  test::Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  reckoner.update(viewer.look(places(0), 0.0), Pose2());
  scan::Scan none;
  none.stamp = 100'000'000;
  const auto update = reckoner.update(none, Pose2());
  ASSERT_TRUE(update);
  EXPECT_EQ(update->state, MatchState::kFailed);
  EXPECT_TRUE(update->pose.covariance.allFinite());
}

INSTANTIATE_TEST_SUITE_P(DeadReckoner, MatchAndCommit,
                         testing::Values(Method::kSubmap, Method::kPoseSpace, Method::kHistogram));

}  // namespace
}  // namespace sightline::dead_reckoning
