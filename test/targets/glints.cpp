// What a look sees of things that are no targets, or are partly hidden.
#include <gtest/gtest.h>

#include "bearing_looks.h"
#include "sightline/targets/bernoulli_filter.h"
#include "sightline/targets/candidate.h"

namespace sightline::targets {
namespace {

SensorModel modelWithGlints(double share) {
  SensorModelConfig config;
  config.clutter.glint_share = share;
  return SensorModel(config);
}

// A robot turns on the spot in sight of bare metal: to looks that were independent that is a
// target.
TEST(BernoulliFilter, TakesNoGlintForATarget) {
  const Eigen::Vector2d metal(2.0, 1.0);
  BernoulliFilterConfig few_targets;
  few_targets.undetected.prior = 0.002;
  for (const double share : {0.0, 0.5}) {
    BernoulliFilter filter(few_targets);
    const SensorModel model = modelWithGlints(share);
    for (int i = 0; i < 12; ++i) {
      const geometry::Pose2 pose(0.0, -1.0, 0.2 * i - 1.0);
      filter.update(test::lookFrom(pose, {test::bearingOf(metal, pose)}, i), model);
    }
    EXPECT_EQ(filter.estimate().targets.size(), share > 0.0 ? 0U : 1U);
    EXPECT_EQ(filter.estimate().expected_number > 0.7, share == 0.0);
  }
}

TEST(BernoulliFilter, FindsTargetsAmongGlints) {
  const SensorModel model = modelWithGlints(0.5);
  const Eigen::Vector2d target(2.0, 1.0);
  BernoulliFilter filter;
  for (int i = 0; i < 12; ++i) {
    const geometry::Pose2 pose(0.25 * i, -1.0, 1.0);
    filter.update(test::lookFrom(pose, {test::bearingOf(target, pose)}, i), model);
  }
  const TargetEstimate estimate = filter.estimate();
  ASSERT_EQ(estimate.targets.size(), 1U);
  EXPECT_LT((estimate.targets[0].mean - target).norm(), 0.15);
}

TEST(Candidate, AGlintIsSeenFromOneSide) {
  const SensorModel model = modelWithGlints(0.5);
  const BearingSet first = test::lookFrom({}, {0.0});
  const Mixture small{{1.0, {2.0, 0.0}, 1e-4 * Eigen::Matrix2d::Identity()}};
  Bernoulli bernoulli;
  bernoulli.existence = 1.0;
  bernoulli.mixture = withModes(small, {0.0, 1.0, 0.0}, Look(first, model));
  EXPECT_EQ(shareOf(bernoulli.mixture, Mode::kGlint), 1.0);
  EXPECT_EQ(targetExistence(bernoulli), 0.0);
  const auto seen = [&](const geometry::Pose2& pose) {
    const BearingSet set = test::lookFrom(pose, {});
    return Candidate(0, bernoulli, Look(set, model)).detection();
  };
  EXPECT_NEAR(seen({0.0, 0.0, 0.5}), model.detection(Polar{2.0, 0.0}), 0.01);
  EXPECT_NEAR(seen({-1.0, 0.0, 0.0}), model.detection(Polar{3.0, 0.0}), 0.01);
  EXPECT_LT(seen({0.0, 1.0, 0.0}), 1e-9);
}

}  // namespace
}  // namespace sightline::targets
