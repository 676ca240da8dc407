#include "sightline/targets/characterization.h"

#include <cmath>

#include <gtest/gtest.h>

#include "config_error.h"
#include "monte_carlo.h"
#include "sightline/targets/simulated_team.h"

namespace sightline::targets {
namespace {

constexpr double kInch = 0.0254;

std::vector<KnownLook> knownLooksOf(SimulatedTeam& team, std::size_t count) {
  std::vector<KnownLook> looks;
  while (looks.size() < count) {
    for (const SimulatedSet& set : team.step()) {
      looks.push_back({set.set.robot, set.set.stamp, set.T_map_sensor, 0.0, set.set.bearings, {}});
    }
  }
  return looks;
}

Characterization characterizeOf(const TeamConfig& team_config, std::size_t looks) {
  SimulatedTeam team(team_config, 7);
  CharacterizationConfig config;
  config.beam_spacing = team_config.model.detection.beam_spacing;
  return characterize(knownLooksOf(team, looks), {"a", "b", "c"}, team.targets(), config);
}

// The paper's own counts.
TEST(PapersArithmetic, AgreesToTheDigitsPrinted) {
  EXPECT_NEAR(1588.0 / (1588.0 + 1007.0), 0.612, 5e-4);
  EXPECT_NEAR((2630.0 - 1588.0) / 1959.0, 0.5319, 5e-5);
  EXPECT_NEAR(100.0 * 1.28 / 1.625, 78.8, 0.05);
  EXPECT_NEAR(geometry::degrees(std::asin(1.28 / 1.625)), 52.0, 0.05);
}

TEST(Labelling, GivesEachTargetOneMeasurement) {
  KnownLook look;
  look.bearings = {0.01, 0.02, 1.0};
  LabellingConfig config;
  const Labels labels = label({look}, {{2.0, 0.0}, {-2.0, 0.0}}, config);
  ASSERT_EQ(labels.opportunities.size(), 1U) << "the other one is behind";
  EXPECT_TRUE(labels.opportunities[0].is_detected);
  EXPECT_NEAR(labels.opportunities[0].error, 0.01, 1e-12);
  EXPECT_EQ(labels.clutter.size(), 2U);
}

TEST(Labelling, TargetsBehindWallsAreNoMisses) {
  world::World world;
  world.add(world::WorldSegment{geometry::Segment{{1.5, -1.0}, {1.5, 1.0}}});
  const KnownLook look;
  LabellingConfig config;
  const std::vector<Eigen::Vector2d> targets{{1.0, 0.0}, {2.0, 0.0}};
  EXPECT_EQ(label({look}, targets, config).opportunities.size(), 2U);
  config.sight = std::make_shared<WorldSight>(world, 0.3);
  const Labels labels = label({look}, targets, config);
  ASSERT_EQ(labels.opportunities.size(), 1U);
  EXPECT_EQ(labels.opportunities[0].target, 0U);
}

// One measurement lies between two targets: given to the nearer one, the other target is missed.
TEST(Labelling, OptimalFindsMorePairsThanNearestFirst) {
  KnownLook look;
  look.bearings = {0.04, 0.11};
  const std::vector<Eigen::Vector2d> targets{{2.0 * std::cos(0.05), 2.0 * std::sin(0.05)},
                                             {2.0 * std::cos(-0.05), 2.0 * std::sin(-0.05)}};
  LabellingConfig config;
  config.sigma = 0.033;
  config.method = LabellingMethod::kNearest;
  EXPECT_EQ(label({look}, targets, config).detected, 1U);
  config.method = LabellingMethod::kOptimal;
  EXPECT_EQ(label({look}, targets, config).detected, 2U);
}

TEST(PaperFit, FindsTheValuesOfExactShares) {
  std::vector<RangeBin> bins;
  const SensorModel model;
  for (double range = 0.1; range < 5.0; range += 0.2) {
    bins.push_back({range, 1.0, model.detection(Polar{range, 0.0})});
  }
  const DetectionFit fit = fitDetection(bins, geometry::radians(1.0));
  EXPECT_NEAR(fit.false_negative, 0.21, 1e-9);
  EXPECT_NEAR(fit.target_diameter, 1.28 * kInch, 1e-9);
}

TEST(CharacterizationStatistics, RecoversThePapersValues) {
  const Characterization found = characterizeOf({}, 1959);
  EXPECT_NEAR(found.detection.false_negative.value, 0.21, 0.09);
  EXPECT_NEAR(found.detection.target_diameter.value / kInch, 1.28, 0.2);
  EXPECT_TRUE(found.detection.target_diameter.is_determined);
  EXPECT_FALSE(found.detection.isRefused());
  EXPECT_NEAR(found.clutter.mean.value, 0.5319, 0.06);
  EXPECT_NEAR(found.clutter.peak_width.value / geometry::kPi, 0.2, 0.07);
  EXPECT_NEAR(found.clutter.uniform_share.value, 0.725, 0.15);
  for (const auto& [name, robot] : found.robots) {
    EXPECT_NEAR(geometry::degrees(robot.errors.sigma), 2.25, 0.35) << name;
    EXPECT_LT(std::abs(robot.errors.bias), 0.01) << name;
  }
}

// A wall across the field: those who do not know of it take every target behind it for missed.
TEST(CharacterizationStatistics, LineOfSightKeepsMissesApart) {
  world::World world;
  world.add(world::WorldSegment{geometry::Segment{{10.0, 0.0}, {10.0, 20.0}}});
  const auto sight = std::make_shared<WorldSight>(std::move(world), 0.3);
  SimulatedTeam team({}, 7, sight);
  const std::vector<KnownLook> looks = knownLooksOf(team, 1959);
  const auto missed = [&](std::shared_ptr<const LineOfSight> told) {
    const Characterization found =
        characterize(looks, {"a", "b", "c"}, team.targets(), {}, std::move(told));
    EXPECT_EQ(found.detection.isRefused(), false);
    const auto tries = static_cast<double>(found.paper_labels.opportunities.size());
    return 1.0 - static_cast<double>(found.paper_labels.detected) / tries;
  };
  EXPECT_NEAR(missed(sight), 0.5, 0.05);
  EXPECT_GT(missed(nullptr), missed(sight) + 0.04);
}

TEST(CharacterizationStatistics, SaysWhatTheDataDoNotDetermine) {
  TeamConfig fine;
  fine.model.detection.beam_spacing = geometry::radians(0.25);
  const Characterization found = characterizeOf(fine, 1959);
  EXPECT_FALSE(found.detection.target_diameter.is_determined);
  bool is_said = false;
  for (const std::string& line : found.report()) {
    is_said = is_said || line.find("d_t: undetermined") != std::string::npos;
  }
  EXPECT_TRUE(is_said);
}

TEST(CharacterizationStatistics, RefusesAModelThatDoesNotHold) {
  TeamConfig odd;
  odd.model.detection.table = DetectionTable{{0.0, 1.5, 3.0, 5.0}, {-2.4, 2.4}, {0.1, 0.8, 0.3}};
  EXPECT_TRUE(characterizeOf(odd, 1959).detection.isRefused());
}

TEST(CharacterizationStatistics, FindsHiddenSpells) {
  TeamConfig correlated;
  correlated.model.visibility = {0.7, 20.0};
  const Characterization found = characterizeOf(correlated, 6000);
  for (const auto& [name, robot] : found.robots) {
    EXPECT_NEAR(robot.visibility.share, 0.7, 0.15) << name;
  }
  for (const auto& [name, robot] : characterizeOf({}, 6000).robots) {
    EXPECT_GT(robot.visibility.share, 0.85) << name;
  }
}

TEST(TeamCharacter, LiesBetweenItsRobots) {
  RobotCharacter dim;
  dim.opportunities = 100;
  dim.table = {{0.0, 1.0}, {-1.0, 1.0}, {0.2}};
  dim.errors.sigma = 0.01;
  dim.errors.bias = -0.02;
  RobotCharacter bright = dim;
  bright.table.probabilities = {0.4};
  bright.errors.bias = 0.02;
  const RobotCharacter team = teamCharacter({{"a", dim}, {"b", bright}});
  EXPECT_NEAR(team.table.probabilities[0], 0.3, 1e-12);
  EXPECT_NEAR(team.errors.bias, 0.0, 1e-12);
  EXPECT_NEAR(team.errors.sigma, std::hypot(0.01, 0.02), 1e-12);
  EXPECT_EQ(team.visibility.share, 1.0);
  EXPECT_NO_THROW(team.model().check());
}

TEST(Characterization, NeedsTargetsAndLooks) {
  EXPECT_EQ(test::errorOf([] { characterize({}, {}, {}, {}); }).key(), "targets");
  EXPECT_EQ(test::errorOf([] { characterize({}, {}, {{1.0, 0.0}}, {}); }).key(), "looks");
}

TEST(Characterization, ItsModelsAreOnesThatLoad) {
  const Characterization found = characterizeOf({}, 600);
  const SensorModelsConfig models = found.models();
  models.common.check();
  EXPECT_EQ(models.robots.size(), 3U);
  for (const auto& [name, model] : models.robots) EXPECT_NO_THROW(model.check(name));
}

}  // namespace
}  // namespace sightline::targets
