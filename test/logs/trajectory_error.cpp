#include "sightline/logs/trajectory_error.h"

#include <cmath>

#include <gmock/gmock.h>

#include "temporary_folder.h"

namespace sightline::logs {
namespace {

using geometry::Pose2;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kSecondInNs = 1'000'000'000;

// Stamps out of order, off by half a millisecond and by one; a relation of which a pose is missing,
// one from a pose to itself, one backwards in time and one across ±π.
const char* const kTrajectory = R"(# t x y z qx qy qz qw
10.000000 0.00 0.00 0 0 0 0 1
11.000000 1.00 0.10 0 0 0 0.0998334166 0.9950041653
12.000500 1.90 0.42 0 0 0 0.1986693308 0.9800665778
13.000000 2.70 0.95 0 0 0 0.2955202067 0.9553364891
20.000000 6.00 5.00 0 0 0 0.9092974268 -0.4161468365
14.000000 3.30 1.60 0.3 0 0 0.3894183423 0.9210609940
)";
const char* const kRelations = R"(10.0 11.001 1.02 0.08 0 0 0 0.19
11.0 12.0 0.95 0.12 0.01 0.0 0.0 0.22
12.0 13.0 0.9 0.3 0 0 0 0.15
13.0 14.0 0.88 0.17 0 0 0 0.2
14.0 15.0 0.9 0 0 0 0 0
10.0 20.0 6.2 4.7 0 0 0 3.1   # a long one
20.0 13.0 5.4 -0.2 0 0 0 2.3
13.0 13.001 0 0 0 0 0 0
)";

// Figures as a script in NumPy printed them, written from the definition of the figures.
const char* const kFigures = R"(relations.used 6 of 8
short.translation.mean 0.0553 m
short.translation.std 0.0395 m
short.translation.median 0.0375 m
short.translation.max 0.1230 m
short.rotation.mean 1.1459 deg
short.rotation.std 1.0719 deg
short.rotation.median 0.8594 deg
short.rotation.max 2.8648 deg
short.bad 25.00 %
all.translation.mean 0.1737 m
all.translation.std 0.1715 m
all.translation.median 0.0816 m
all.translation.max 0.4421 m
all.rotation.mean 14.9273 deg
all.rotation.std 20.2010 deg
all.rotation.median 2.0054 deg
all.rotation.max 51.5662 deg
)";

TEST(CompareWithRelations, GivesTheFiguresOfTheReference) {
  const TemporaryFolder folder;
  const Trajectory trajectory = readTrajectory(folder.write("a.tum", kTrajectory));
  const auto relations = readRelations(folder.write("a.relations", kRelations));
  EXPECT_EQ(figures(compareWithRelations(trajectory, relations, {0.04, 0.0, 0.0})), kFigures);
}

TEST(CompareWithRelations, TakesTheOffsetAsAPoseInTheBody) {
  const Pose2 T_body_measured(0.04, -0.1, 0.2);
  Trajectory body;
  Trajectory measured;
  for (int i = 0; i < 4; ++i) {
    body.push_back({i * kSecondInNs, Pose2(0.5 * i, 0.1 * i * i, 0.7 * i)});
    measured.push_back({i * kSecondInNs, body.back().pose * T_body_measured});
  }
  std::vector<Relation> relations;
  for (std::size_t i = 1; i < 4; ++i) {
    relations.push_back({measured[i - 1].stamp, measured[i].stamp,
                         between(measured[i - 1].pose, measured[i].pose)});
  }
  const auto errors = compareWithRelations(body, relations, T_body_measured);
  EXPECT_EQ(errors.used, 3U);
  EXPECT_NEAR(errors.all->translation.max, 0.0, 1e-12);
  EXPECT_NEAR(errors.all->rotation.max, 0.0, 1e-12);
  EXPECT_GT(compareWithRelations(body, relations).all->translation.max, 0.01);
}

TEST(CompareWithRelations, SaysThatNoRelationIsUsed) {
  const auto errors =
      compareWithRelations({{kSecondInNs, {}}}, {{kSecondInNs, kSecondInNs, {}}}, {});
  EXPECT_EQ(errors.used, 0U);
  EXPECT_EQ(figures(errors, "here."), "here.relations.used 0 of 1\n");
}

TEST(CompareWithRelations, KeepsLongRelationsOutOfTheShortOnes) {
  const Trajectory trajectory = {{0, {}}, {6 * kSecondInNs, {1, 0, 0}}};
  const auto errors = compareWithRelations(trajectory, {{0, 6 * kSecondInNs, {1, 0, 0}}});
  EXPECT_FALSE(errors.short_term.has_value());
  ASSERT_TRUE(errors.all.has_value());
  EXPECT_THAT(figures(errors), Not(HasSubstr("short")));
}

TEST(CompareWithTruth, InterpolatesTheTruth) {
  const Trajectory truth = {
      {0, {0, 0, 0}}, {kSecondInNs, {1, 0, 0.2}}, {3 * kSecondInNs, {3, 0, 0.2}}};
  // At the middle of an arc, exactly at a pose, within too wide a gap, before and after the truth.
  const Pose2 middle = geometry::interpolate(truth[0].pose, truth[1].pose, 0.5);
  const Trajectory trajectory = {{-1, {}},
                                 {kSecondInNs / 2, middle * Pose2(0.03, 0.04, -0.1)},
                                 {kSecondInNs, {1.1, 0, 0.2}},
                                 {2 * kSecondInNs, {9, 9, 9}},
                                 {4 * kSecondInNs, {}}};
  const auto errors = compareWithTruth(trajectory, truth);
  EXPECT_EQ(errors.used, 2U);
  EXPECT_EQ(errors.total, 5U);
  EXPECT_NEAR(errors.absolute->translation.mean, 0.075, 1e-12);
  EXPECT_NEAR(errors.absolute->translation.max, 0.1, 1e-12);
  EXPECT_NEAR(errors.absolute->rotation.max, geometry::degrees(0.1), 1e-9);
  EXPECT_THAT(figures(errors),
              HasSubstr("truth.used 2 of 5\nabsolute.translation.mean 0.0750 m\n"));
}

TEST(CompareWithTruth, TakesTheOffsetAsAPoseInTheBody) {
  const Pose2 T_body_measured(0.3, 0.0, 0.1);
  const Pose2 body(2.0, 1.0, 1.5);
  const auto errors = compareWithTruth({{kSecondInNs, body}},
                                       {{kSecondInNs, body * T_body_measured}}, T_body_measured);
  EXPECT_NEAR(errors.absolute->translation.max, 0.0, 1e-12);
}

TEST(CompareWithTruth, SaysThatNoPoseIsUsed) {
  EXPECT_EQ(figures(compareWithTruth({{kSecondInNs, {}}}, {{0, {}}})), "truth.used 0 of 1\n");
}

TEST(StatisticsOf, AreThoseOfThePopulation) {
  const Statistics even = statisticsOf({4.0, 1.0, 3.0, 2.0});
  EXPECT_DOUBLE_EQ(even.mean, 2.5);
  EXPECT_DOUBLE_EQ(even.median, 2.5);
  EXPECT_DOUBLE_EQ(even.std, std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(even.max, 4.0);
  EXPECT_DOUBLE_EQ(statisticsOf({5.0, 1.0, 3.0}).median, 3.0);
}

}  // namespace
}  // namespace sightline::logs
