#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "bearing_looks.h"
#include "monte_carlo.h"
#include "numeric_jacobian.h"
#include "sightline/targets/belief_propagation.h"
#include "sightline/targets/bernoulli_filter.h"
#include "sightline/targets/phd_filter.h"

namespace sightline::targets {
namespace {

using test::bearingOf;
using test::lookFrom;

TEST(Bernoulli, BearingJacobiansAreThoseOfTheBearing) {
  const Eigen::Vector2d point(2.0, -1.5);
  const geometry::Pose2 pose(0.3, 0.4, 2.0);
  const BearingJacobians jacobians = bearingJacobians(point, pose);
  const auto of_point = test::numericJacobian<1, 2>(
      [&](const Eigen::Vector2d& p) { return Eigen::Matrix<double, 1, 1>(bearingOf(p, pose)); },
      point);
  const auto of_pose = test::numericJacobian<1, 3>(
      [&](const Eigen::Vector3d& q) {
        return Eigen::Matrix<double, 1, 1>(bearingOf(point, geometry::Pose2(q)));
      },
      pose.coordinates());
  EXPECT_LT((jacobians.point - of_point).norm(), 1e-8);
  EXPECT_LT((jacobians.pose - of_pose).norm(), 1e-8);
}

TEST(Bernoulli, MergingKeepsMeanAndCovariance) {
  test::Gauss gauss(3);
  Mixture mixture;
  for (int i = 0; i < 5; ++i) {
    mixture.push_back({0.2, {gauss(0.3), gauss(0.3)}, Eigen::Matrix2d::Identity()});
  }
  const UncertainPoint before = momentsOf(mixture);
  reduce(mixture, 100.0, 0.0, 8);
  ASSERT_EQ(mixture.size(), 1U);
  EXPECT_LT((mixture[0].mean - before.mean).norm(), 1e-12);
  EXPECT_LT((mixture[0].covariance - before.covariance).norm(), 1e-12);
}

TEST(Bernoulli, StandingAndMovingStayApart) {
  Mixture mixture{{0.5, {0.0, 0.0}, Eigen::Matrix2d::Identity()},
                  {0.5, {0.0, 0.0}, Eigen::Matrix2d::Identity(), Mode::kMoving}};
  reduce(mixture, 100.0, 0.0, 8);
  EXPECT_EQ(mixture.size(), 2U);
}

// All ways to give two targets two measurements, one to one, by their weights.
TEST(BeliefPropagation, IsExactForOneTargetAndNearForTwo) {
  const Eigen::MatrixXd one = (Eigen::MatrixXd(1, 3) << 2.0, 0.5, 0.1).finished();
  const Association exact = associate(one);
  for (int m = 0; m < 3; ++m) EXPECT_NEAR(exact.assigned(0, m), one(0, m) / 3.6, 1e-9);
  EXPECT_NEAR(exact.unassigned[0], 1.6 / 3.6, 1e-4);
  const Eigen::MatrixXd two = (Eigen::MatrixXd(2, 2) << 3.0, 1.0, 0.5, 2.0).finished();
  const double both = two(0, 0) * two(1, 1);
  const double crossed = two(0, 1) * two(1, 0);
  const double total = 1.0 + two.sum() + both + crossed;
  const Association near = associate(two);
  EXPECT_NEAR(near.assigned(0, 0), (two(0, 0) + both) / total, 0.05);
  EXPECT_NEAR(near.assigned(1, 0), (two(1, 0) + crossed) / total, 0.05);
}

TEST(BeliefPropagation, TakesEmptySets) {
  EXPECT_EQ(associate(Eigen::MatrixXd(0, 2)).unassigned.size(), 2);
  EXPECT_EQ(associate(Eigen::MatrixXd(2, 0)).assigned.rows(), 2);
  EXPECT_NEAR(associate(Eigen::MatrixXd(0, 2)).unassigned[1], 1.0, 1e-12);
}

TEST(Undetected, LooksLeaveLessDownToTheFloor) {
  UndetectedConfig config;
  config.area = {0.0, 0.0, 10.0, 10.0};
  Undetected undetected(config);
  const SensorModel model;
  const geometry::Pose2 pose(5.0, 5.0, 0.0);
  undetected.look(pose, model, model.config().field_of_view);
  EXPECT_NEAR(undetected.at({6.25, 5.25}), config.prior * 0.21, 1e-12);
  EXPECT_NEAR(undetected.at({3.25, 5.25}), config.prior, 1e-12);
  EXPECT_EQ(undetected.at({-1.0, 5.0}), 0.0);
  for (int i = 0; i < 20; ++i) undetected.look(pose, model, model.config().field_of_view);
  EXPECT_EQ(undetected.at({6.25, 5.25}), config.floor);
}

TEST(BernoulliFilter, FindsTheOneTargetFromTwoPlaces) {
  BernoulliFilter filter;
  const SensorModel model;
  const Eigen::Vector2d target(2.0, 1.0);
  for (int i = 0; i < 12; ++i) {
    const geometry::Pose2 pose(0.25 * i, -1.0, 1.0);
    filter.update(lookFrom(pose, {bearingOf(target, pose)}, i), model);
  }
  const TargetEstimate estimate = filter.estimate();
  ASSERT_EQ(estimate.targets.size(), 1U);
  EXPECT_EQ(estimate.targets[0].label, 1U);
  EXPECT_LT((estimate.targets[0].mean - target).norm(), 0.15);
  EXPECT_GT(estimate.targets[0].probability, 0.95);
  EXPECT_NEAR(estimate.expected_number, 1.0, 0.2);
}

TEST(BernoulliFilter, GivesUpWhatIsNotSeenAgain) {
  BernoulliFilter filter;
  const SensorModel model;
  filter.update(lookFrom({}, {0.3}), model);
  EXPECT_GT(filter.estimate().expected_number, 0.1);
  for (int i = 1; i < 30; ++i) filter.update(lookFrom({}, {}, i), model);
  EXPECT_LT(filter.estimate().expected_number, 0.05);
}

TEST(BernoulliFilter, TakesOneHiddenSpellForNoAbsence) {
  SensorModelConfig config;
  config.visibility = {0.9, 20.0};
  const SensorModel correlated(config);
  const SensorModel independent;
  const Eigen::Vector2d target(2.0, 1.0);
  for (const bool is_told : {true, false}) {
    BernoulliFilter filter;
    const SensorModel& model = is_told ? correlated : independent;
    for (int i = 0; i < 40; ++i) {
      const geometry::Pose2 pose(0.1 * i, -1.0, 1.0);
      const bool is_hidden = i > 25;
      filter.update(
          lookFrom(pose,
                   is_hidden ? std::vector<double>{} : std::vector<double>{bearingOf(target, pose)},
                   i),
          model);
    }
    EXPECT_EQ(filter.estimate().targets.size(), is_told ? 1U : 0U);
  }
}

TEST(BernoulliFilter, SurvivesAModelThatIsSureToDetect) {
  TeamConfig team_config;
  SensorModelConfig sure = team_config.model;
  sure.detection.false_negative = 0.0;
  sure.detection.target_diameter = 10.0;
  const SensorModel model(sure);
  SimulatedTeam team(team_config, 3);
  BernoulliFilter filter;
  for (int i = 0; i < 200; ++i) {
    for (const SimulatedSet& set : team.step()) filter.update(set.set, model);
    const TargetEstimate estimate = filter.estimate();
    ASSERT_TRUE(std::isfinite(estimate.expected_number));
    for (const Target& target : estimate.targets) {
      ASSERT_TRUE(target.mean.allFinite() && target.covariance.allFinite());
    }
  }
}

TEST(BernoulliFilter, ExplainsWhatIsKnown) {
  const SensorModel model;
  const Eigen::Vector2d mate(2.0, 1.0);
  BernoulliFilter filter;
  for (int i = 0; i < 12; ++i) {
    const geometry::Pose2 pose(0.25 * i, -1.0, 1.0);
    BearingSet set = lookFrom(pose, {bearingOf(mate, pose)}, i);
    set.known.push_back({mate, 0.0025 * Eigen::Matrix2d::Identity()});
    filter.update(set, model);
  }
  EXPECT_TRUE(filter.estimate().targets.empty());
}

TEST(BernoulliFilter, KnowsWhatMoves) {
  BernoulliFilterConfig config;
  config.moving_share = 0.3;
  config.moving_noise = 0.02;
  BernoulliFilter filter(config);
  const SensorModel model;
  const Eigen::Vector2d standing(2.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    const geometry::Pose2 pose(2.0 * std::sin(0.3 * i), -1.0, 1.5);
    const Eigen::Vector2d walking(-1.5 + 0.05 * i, 2.5);
    filter.update(lookFrom(pose, {bearingOf(standing, pose), bearingOf(walking, pose)}, i), model);
  }
  for (const Target& target : filter.estimate().targets) {
    const bool is_standing = (target.mean - standing).norm() < 0.5;
    EXPECT_EQ(target.moving < 0.5, is_standing) << target.mean.transpose();
  }
}

TEST(BernoulliFilter, GainsFromPosesThatAreKnownToBeOff) {
  const SensorModel model;
  BearingSet exact = lookFrom({}, {0.3});
  BearingSet vague = exact;
  vague.T_map_sensor.covariance = Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal();
  BernoulliFilter by_exact;
  BernoulliFilter by_vague;
  by_exact.update(exact, model);
  by_vague.update(vague, model);
  EXPECT_GT(momentsOf(by_vague.bernoullis()[0].mixture).covariance.determinant(),
            1.5 * momentsOf(by_exact.bernoullis()[0].mixture).covariance.determinant());
}

// A robot that stands looks at one target again and again, with an error that stays.
TEST(BernoulliFilter, IsNotMadeSureByLooksThatErrAlike) {
  SensorModelConfig config;
  config.bearing.lasting_share = 0.25;
  config.bearing.lasting_duration = 1e5;
  const SensorModel model(config);
  BernoulliFilter filter;
  for (int i = 1; i <= 400; ++i) {
    BearingSet set = lookFrom({}, {0.0});
    set.stamp = i * 1'000'000;
    filter.update(set, model);
  }
  const Mixture mixture = ofTarget(filter.bernoullis()[0].mixture);
  const double range = mixture.front().mean.norm();
  const double across = std::sqrt(mixture.front().covariance(1, 1)) / range;
  EXPECT_NEAR(across, 0.5 * config.bearing.sigma, 0.05 * config.bearing.sigma);
}

TEST(PhdFilter, MassIsWhatOneLookSays) {
  PhdFilterConfig config;
  config.undetected.area = {0.0, 0.0, 20.0, 20.0};
  PhdFilter filter(config);
  const SensorModel model;
  const BearingSet set = lookFrom({10.0, 10.0, 0.0}, {0.3});
  const Look look(set, model);
  const Birth birth =
      birthAlong(look, 0, Undetected(config.undetected), config.ranges, config.nearest);
  filter.update(set, model);
  EXPECT_NEAR(filter.mass(), birth.mass / (birth.mass + look.clutter(0)), 1e-9);
}

}  // namespace
}  // namespace sightline::targets
