#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "dead_reckoning/simulated_scans.h"
#include "sightline/dead_reckoning/dead_reckoner.h"

namespace sightline::dead_reckoning {
namespace {

using geometry::Pose2;

constexpr double kSteady = 0.2;  // between two scans [s]

Pose2 onBend(int scan) {
  return Pose2(-1.5, 0.5, 0.0) * Pose2::exp(scan * Eigen::Vector3d(0.08, 0.0, 0.05));
}

void expectAt(const Pose2& pose, const Pose2& expected) {
  const Pose2 error = geometry::between(expected, pose);
  EXPECT_LT(error.translation().norm(), 0.02);
  EXPECT_LT(std::abs(error.theta()), 0.01);
}

TEST(DeadReckonerTime, NoGapClearsTheReference) {
  for (const double gap : {4.0, 60.0, 3600.0}) {
    DeadReckoner reckoner({});
    test::Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
    reckoner.update(viewer.look(onBend(0), 0.0), Pose2());
    const auto after = reckoner.update(viewer.look(onBend(6), gap), Pose2());
    EXPECT_EQ(after->state, MatchState::kMatched) << gap;
    expectAt(after->step.mean, geometry::between(onBend(0), onBend(6)));
    const auto next = reckoner.update(viewer.look(onBend(7), gap + 0.2), Pose2());
    EXPECT_EQ(next->state, MatchState::kMatched) << gap;
    expectAt(next->pose.mean, geometry::between(onBend(0), onBend(7)));
  }
}

TEST(DeadReckonerTime, GoesByTheClockWhereTheStampsDoNotTellTheTime) {
  DeadReckoner reckoner({});
  test::Viewer viewer(test::furnishedRoom(), test::scanner(), 1);
  std::optional<DeadReckoningUpdate> update;
  // All of one burst, and the third a period late: a scan was lost before it.
  const scan::ElapsedTime elapsed{kSteady, 3.0 * kSteady, 0.02 * kSteady};
  int place = 0;
  for (int i = 0; i < 8; ++i, ++place) {
    if (i == 3) ++place;
    const double stamp = 1.0 - 0.001 * i;
    update = reckoner.update(viewer.look(onBend(place), stamp), Pose2(), {}, elapsed);
    ASSERT_TRUE(update) << i;
    EXPECT_FALSE(update->isFlagged()) << i;
  }
  expectAt(update->pose.mean, geometry::between(onBend(0), onBend(8)));
  const Eigen::Vector3d twist = geometry::between(onBend(7), onBend(8)).log() / kSteady;
  EXPECT_LT((update->twist.mean - twist).norm(), 0.1);
  EXPECT_GT(update->twist.covariance(0, 0), 1e-4 * twist.x() * twist.x());
}

}  // namespace
}  // namespace sightline::dead_reckoning
