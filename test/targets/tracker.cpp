// TargetTracker: what it refuses and spares; logs of targets and their scores.
#include "sightline/targets/target_tracker.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "config_error.h"
#include "sightline/targets/target_log.h"
#include "temporary_folder.h"

namespace sightline::targets {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

BearingSet lookAt(double time, const geometry::Pose2& pose = {}) {
  BearingSet set;
  set.stamp = std::llround(1e9 * time);
  set.T_map_sensor.mean = pose;
  set.bearings = {0.3};
  set.field_of_view = {-2.0, 2.0};
  return set;
}

std::string reasonOf(const BearingSet& set) {
  TargetTracker tracker({});
  const auto verdict = tracker.take("robot1", set);
  EXPECT_EQ(verdict.outcome, LookOutcome::kRefused);
  return verdict.reason;
}

template <class Change>
std::string reasonAfter(const Change& change) {
  BearingSet set = lookAt(10.0);
  change(set);
  return reasonOf(set);
}

TEST(TargetTracker, NamesWhatItCannotUse) {
  EXPECT_EQ(reasonAfter([](auto& set) { set.stamp = 0; }), "a stamp of zero");
  EXPECT_EQ(reasonAfter([](auto& set) { set.field_of_view = {1.0, 1.0}; }), "no field of view");
  EXPECT_EQ(reasonAfter([](auto& set) { set.field_of_view.min = kNan; }), "no field of view");
  EXPECT_EQ(reasonAfter([](auto& set) { set.bearings = {kNan}; }), "a bearing that is not finite");
  EXPECT_EQ(reasonAfter([](auto& set) { set.bearings = {40.0}; }), "a bearing beyond a turn");
  EXPECT_EQ(reasonAfter([](auto& set) { set.sigma = -0.1; }),
            "a negative or missing standard deviation");
  EXPECT_EQ(reasonAfter([](auto& set) { set.range_max = 0.0; }), "no range");
  EXPECT_EQ(reasonAfter([](auto& set) {
              set.T_map_sensor.mean = {kNan, 0.0, 0.0};
            }),
            "a pose that is not finite");
  EXPECT_EQ(reasonAfter([](auto& set) { set.T_map_sensor.covariance(0, 0) = -1.0; }),
            "a pose whose covariance is none");
}

TEST(TargetTracker, RefusesLooksOfAnHourAgoAndTakesLateOnes) {
  TargetTracker tracker({});
  EXPECT_EQ(tracker.take("robot1", lookAt(4000.0)).outcome, LookOutcome::kUsed);
  EXPECT_EQ(tracker.take("robot2", lookAt(400.0)).reason, "3600.0 s older than the newest look");
  EXPECT_EQ(tracker.take("robot2", lookAt(3999.0, {3.0, 0.0, 0.0})).outcome, LookOutcome::kUsed);
  EXPECT_EQ(tracker.take("robot1", lookAt(3999.5, {1.0, 0.0, 0.0})).outcome, LookOutcome::kUsed);
}

TEST(TargetTracker, SparesLooksFromTheSamePlace) {
  TargetTracker tracker({});
  EXPECT_EQ(tracker.take("robot1", lookAt(10.0)).outcome, LookOutcome::kUsed);
  EXPECT_EQ(tracker.take("robot1", lookAt(11.0)).outcome, LookOutcome::kSpared);
  EXPECT_EQ(tracker.take("robot2", lookAt(11.0)).outcome, LookOutcome::kUsed);
  EXPECT_EQ(tracker.take("robot1", lookAt(11.5, {0.11, 0.0, 0.0})).outcome, LookOutcome::kUsed);
  EXPECT_EQ(tracker.take("robot1", lookAt(12.0, {0.11, 0.0, 0.1})).outcome, LookOutcome::kUsed);
  EXPECT_EQ(tracker.take("robot1", lookAt(17.1, {0.11, 0.0, 0.1})).outcome, LookOutcome::kUsed);
}

TEST(TargetTracker, MatesAreNoTargets) {
  for (const bool explain : {true, false}) {
    TargetTrackerConfig config;
    config.explain_mates = explain;
    TargetTracker tracker(config);
    for (int i = 0; i < 20; ++i) {
      const geometry::Pose2 pose(0.2 * i, -1.0, 1.5);
      const geometry::Pose2 mate(2.0, 1.0 + 0.001 * i, 1.5);
      BearingSet of_mate = lookAt(10.0 + i, mate);
      of_mate.bearings.clear();
      tracker.take("robot2", of_mate);
      BearingSet set = lookAt(10.0 + i, pose);
      set.bearings = {polarOf(pose.inverse() * mate.translation()).bearing};
      tracker.take("robot1", set);
    }
    EXPECT_EQ(tracker.estimate().targets.empty(), explain);
  }
}

// A robot whose pose stops coming is still there to be seen: it stands, then drives off slowly.
TEST(TargetTracker, ARobotThatFallsSilentIsNoTarget) {
  constexpr int kHeard = 6;
  TargetTracker tracker({});
  for (int i = 0; i < 60; ++i) {
    const geometry::Pose2 pose(0.2 * (i % 20), -1.0, 1.5);
    const geometry::Pose2 mate(2.0, 1.0 + (i < 30 ? 0.0 : 0.02 * (i - 30)), 1.5);
    BearingSet of_mate = lookAt(10.0 + i, mate);
    of_mate.bearings.clear();
    if (i < kHeard) tracker.take("robot2", of_mate);
    BearingSet set = lookAt(10.0 + i, pose);
    set.bearings = {polarOf(pose.inverse() * mate.translation()).bearing};
    tracker.take("robot1", set);
    EXPECT_TRUE(tracker.estimate().targets.empty()) << i;
  }
}

TEST(BernoulliFilter, ForgetsALostRobotWhosePoseComes) {
  BernoulliFilter filter;
  BearingSet set = lookAt(10.0);
  set.bearings.clear();
  set.lost.push_back({1, {{2.0, 0.0}, Eigen::Matrix2d::Identity() * 0.01}, set.stamp});
  filter.update(set, SensorModel());
  filter.update(set, SensorModel());
  ASSERT_EQ(filter.bernoullis().size(), 1U);
  EXPECT_EQ(targetExistence(filter.bernoullis().front()), 0.0);
  set.lost.clear();
  filter.update(set, SensorModel());
  EXPECT_TRUE(filter.bernoullis().empty());
}

TEST(TargetTracker, ForgetsAllWhenReset) {
  TargetTracker tracker({});
  tracker.take("robot1", lookAt(4000.0));
  tracker.reset();
  EXPECT_EQ(tracker.take("robot1", lookAt(10.0)).outcome, LookOutcome::kUsed);
  EXPECT_EQ(tracker.estimate().stamp, 10'000'000'000);
}

TEST(SensorModels, NameTheRobotThatIsWrong) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("models.yaml",
                                 "bearing: {sigma: 0.01}\n"
                                 "robots:\n  robot4: {field_of_view: {min: -0.6, max: 0.6}}\n");
  EXPECT_EQ(test::errorOf([&] { SensorModelsConfig::readFile(path); }).key(),
            "robots.robot4.clutter.peak_width");
}

TargetEstimate estimateOf(double time, const std::vector<Eigen::Vector2d>& places) {
  TargetEstimate estimate;
  estimate.stamp = std::llround(1e9 * time);
  estimate.expected_number = static_cast<double>(places.size());
  for (const auto& place : places) {
    estimate.targets.push_back({static_cast<std::uint32_t>(estimate.targets.size() + 1), place,
                                0.01 * Eigen::Matrix2d::Identity(), 0.9, 0.0});
  }
  return estimate;
}

TEST(TargetLog, IsReadBackAsWritten) {
  const test::TemporaryFolder folder;
  TargetLogWriter writer(folder.path("targets.csv"));
  writer.add(estimateOf(1.5, {}));
  writer.add(estimateOf(2.5, {{1.0, 2.0}, {3.0, -4.0}}));
  writer.close();
  const auto read = readTargetLog(folder.path("targets.csv"));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_TRUE(read[0].targets.empty());
  ASSERT_EQ(read[1].targets.size(), 2U);
  EXPECT_EQ(read[1].targets[1].label, 2U);
  EXPECT_EQ(read[1].targets[1].mean, Eigen::Vector2d(3.0, -4.0));
  EXPECT_EQ(read[1].expected_number, 2.0);
}

TEST(TargetLog, NamesFileLineAndColumn) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("a.csv",
                                 "stamp,label,x,y,cov_xx,cov_xy,cov_yy,probability,moving\n"
                                 "1.0,1,0,0,1,0,1,0.5,0\n");
  const auto error = test::errorOf([&] { readTargetLog(path); });
  EXPECT_EQ(error.line(), 2);
  EXPECT_EQ(error.key(), "label");
}

TEST(TargetLog, ScoresWhatStandsAtEachMoment) {
  const std::vector<TargetEstimate> estimates{
      estimateOf(100.0, {}), estimateOf(105.0, {{0.0, 0.0}}),
      estimateOf(115.0, {{0.0, 0.1}, {9.0, 9.0}}), estimateOf(120.0, {})};
  const TargetScore score = targets::score(estimates, {{0.0, 0.0}}, {}, {0.0, 20.0}, 10.0);
  EXPECT_EQ(score.moments, 2U);
  EXPECT_NEAR(score.ospa, 2.5, 1e-12);  // nothing at 0 s, and the target itself at 10 s
  EXPECT_NEAR(score.number_error, 0.5, 1e-12);
  const TargetScore late = targets::score(estimates, {{0.0, 0.0}}, {}, {16.0, 20.0}, 10.0);
  EXPECT_NEAR(late.ospa, 0.5 * (0.1 + 5.0), 1e-12);
  EXPECT_NEAR(late.spurious, 1.0, 1e-12);
  EXPECT_NEAR(late.nees, 1.0, 1e-9);
  EXPECT_EQ(late.inside, 1.0);
}

}  // namespace
}  // namespace sightline::targets
