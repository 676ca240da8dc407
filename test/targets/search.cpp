#include "sightline/targets/search.h"

#include <cmath>

#include <gtest/gtest.h>

#include "config_error.h"

namespace sightline::targets {
namespace {

using geometry::kPi;
using geometry::Pose2;

std::shared_ptr<const LineOfSight> wallAt(double x) {
  world::World world;
  world.add(world::WorldSegment{{{x, -50.0}, {x, 50.0}}, 0.0, 2.5, 0});
  return std::make_shared<WorldSight>(std::move(world), 0.3);
}

TEST(ActionSet, IsThatOfFigureThree) {
  const ActionSet set{ActionSetConfig{}};
  const auto actions = set.from(Pose2(1.0, 2.0, 0.5));
  EXPECT_EQ(actions.size(), 24u) << "eight headings, three lengths";
  for (const SearchAction& action : actions) {
    ASSERT_EQ(action.poses.size(), 3u);
    const double length = (action.poses[2].translation() - Eigen::Vector2d(1.0, 2.0)).norm();
    EXPECT_NEAR((action.poses[0].translation() - Eigen::Vector2d(1.0, 2.0)).norm(), length / 3.0,
                1e-9);
    const double turn = std::abs(geometry::wrapAngle(action.poses[0].theta() - 0.5));
    EXPECT_NEAR(action.duration, turn / 0.8 + length / 0.5, 1e-9);
  }
}

TEST(ActionSet, EndsBeforeWallsAndTheArea) {
  ActionSetConfig config;
  config.headings = 1;
  const auto by_wall = ActionSet(config, wallAt(3.0)).from(Pose2());
  ASSERT_EQ(by_wall.size(), 2u) << "1 m, and what is left of 4.5 m; 20 m would end there, too";
  EXPECT_NEAR(by_wall[1].poses.back().x(), 2.6, 0.2);
  config.area = {-1.0, -1.0, 2.0, 1.0};
  const auto by_area = ActionSet(config).from(Pose2());
  EXPECT_NEAR(by_area.back().poses.back().x(), 1.6, 0.06);
}

TEST(ActionSet, LeadsAwayFromAWallThatIsTooNear) {
  const auto actions = ActionSet(ActionSetConfig{}, wallAt(0.2)).from(Pose2());
  ASSERT_FALSE(actions.empty());
  for (const SearchAction& action : actions) EXPECT_LT(action.poses.back().x(), 0.2);
}

TEST(ActionSet, RefusesSettingsThatDoNotFit) {
  ActionSetConfig config;
  config.lengths.clear();
  EXPECT_EQ(test::errorOf([&] { config.check("s"); }).key(), "lengths");
  config = {};
  config.area = {1.0, 2.0, 0.0, 3.0};
  EXPECT_EQ(test::errorOf([&] { config.check("s"); }).key(), "area");
}

TEST(Search, InformationIsNoneWhereNothingIsInViewOrSure) {
  EXPECT_EQ(emptinessInformation({0.0, 0.0}, 0.5), 0.0);
  EXPECT_GT(emptinessInformation({1.0, 0.8}, 0.5), emptinessInformation({0.01, 0.008}, 0.5));
  EXPECT_GT(emptinessInformation({1.0, 0.8}, 0.0), emptinessInformation({1.0, 0.8}, 2.0))
      << "clutter hides whether anybody is there";
  // One bit at most, that of the look.
  EXPECT_LT(emptinessInformation({0.7, 0.7}, 0.0), std::log(2.0));
}

SearchConfig searchOf(SearchGain gain) {
  SearchConfig config;
  config.gain = gain;
  config.undetected.area = {-30.0, -30.0, 30.0, 30.0};
  config.actions.area = config.undetected.area;
  return config;
}

// The half plane left of the y axis is known well.
void lookLeft(Search& search) {
  for (int pass = 0; pass < 12; ++pass) {
    for (double x = -30.0; x <= -4.0; x += 2.0) {
      for (double y = -30.0; y <= 30.0; y += 3.0) {
        BearingSet set;
        set.T_map_sensor.mean = Pose2(x, y, kPi);
        search.look("robot1", set);
      }
    }
  }
}

TEST(Search, GoesWhereNobodyHasLooked) {
  for (const auto gain : {SearchGain::kDetections, SearchGain::kInformation}) {
    Search search(searchOf(gain), {});
    lookLeft(search);
    const auto choices = search.plan({{"robot1", Pose2(-2.0, 0.0, kPi)}});
    ASSERT_TRUE(choices[0]);
    EXPECT_GT(choices[0]->action.poses.back().x(), -1.9) << "away from what is known";
    EXPECT_GT(choices[0]->gain, 0.0);
  }
}

TEST(Search, SendsTwoRobotsDifferentWays) {
  Search search(searchOf(SearchGain::kDetections), {});
  const auto choices = search.plan({{"robot1", Pose2()}, {"robot2", Pose2()}});
  const Eigen::Vector2d first = choices[0]->action.poses.back().translation();
  const Eigen::Vector2d second = choices[1]->action.poses.back().translation();
  EXPECT_GT((first - second).norm(), 1.0);
}

TEST(Search, AtRandomGoesEverywhere) {
  Search search(searchOf(SearchGain::kRandom), {});
  double east = 0.0;
  for (int i = 0; i < 400; ++i) {
    const auto choices = search.plan({{"robot1", Pose2()}});
    east += choices[0]->action.poses.back().x() > 0.1 ? 1.0 : 0.0;
  }
  EXPECT_NEAR(east / 400.0, 3.0 / 8.0, 0.1);
}

TEST(Search, ARobotThatCannotGoAnywhereStays) {
  SearchConfig config = searchOf(SearchGain::kDetections);
  config.actions.area = {-0.1, -0.1, 0.1, 0.1};
  Search search(config, {});
  EXPECT_FALSE(search.plan({{"robot1", Pose2()}})[0]);
}

TEST(Search, ExpectsLessAfterALook) {
  Search search(searchOf(SearchGain::kDetections), {});
  search.plan({{"robot1", Pose2()}});
  const double before = search.expectedUndetected();
  search.look("robot1", BearingSet{});
  EXPECT_LT(search.expectedUndetected(), before - 0.5);
  search.reset();
  search.plan({{"robot1", Pose2()}});
  EXPECT_NEAR(search.expectedUndetected(), before, 1e-9);
}

}  // namespace
}  // namespace sightline::targets
