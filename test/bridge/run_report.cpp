#include "sightline/bridge/run_report.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>

#include "sightline/LineSegmentArray.h"
#include "sightline/TrackerStatus.h"
#include "sightline/bridge/odometry_conversion.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/config/error.h"

namespace sightline::bridge {
namespace {

using geometry::Pose2;

constexpr std::int64_t kSecond = 1'000'000'000;

// Ten scans a second for ten seconds along x, each with its pose; truth twice a second.
RecordedRun goodRun() {
  RecordedRun run;
  for (int i = 0; i < 100; ++i) {
    const std::int64_t stamp = kSecond + i * kSecond / 10;
    run.scans.push_back(stamp);
    run.poses.push_back({stamp, Pose2(0.1 * i + 0.01, 0.0, 0.001)});
  }
  for (int i = 0; i <= 20; ++i)
    run.truth.push_back({kSecond + i * kSecond / 2, Pose2(0.5 * i, 0.0, 0.0)});
  return run;
}

TEST(RunReport, AcceptsARunWithAPoseForEveryScan) {
  const RunReport report = judge(goodRun());
  EXPECT_TRUE(report.isGood({}));
  ASSERT_EQ(report.errors.size(), 100u);
  for (const PoseError& error : report.errors) {
    EXPECT_NEAR(error.position, 0.01, 1e-9);
    EXPECT_NEAR(error.heading, 0.001, 1e-9);
  }
}

TEST(RunReport, RefusesOnePoseOutOfBounds) {
  RecordedRun run = goodRun();
  run.poses[40].pose = Pose2(4.0, 0.151, 0.0);
  EXPECT_FALSE(judge(run).isGood({}));
  run = goodRun();
  run.poses[40].pose = Pose2(4.0, 0.0, -geometry::radians(3.1));
  EXPECT_FALSE(judge(run).isGood({}));
}

TEST(RunReport, RefusesAScanWithoutAPoseBetweenOthers) {
  RecordedRun run = goodRun();
  run.poses.erase(run.poses.begin() + 50);
  const RunReport report = judge(run);
  EXPECT_EQ(report.scans_between, 1u);
  EXPECT_FALSE(report.isGood({}));
}

TEST(RunReport, CountsScansOutsideThePosesAndBearsThemForAMoment) {
  RecordedRun run = goodRun();
  run.poses.erase(run.poses.begin(), run.poses.begin() + 7);
  run.poses.erase(run.poses.end() - 2, run.poses.end());
  const RunReport report = judge(run);
  EXPECT_EQ(report.scans_before, 7u);
  EXPECT_EQ(report.scans_after, 2u);
  EXPECT_TRUE(report.isGood({}));
  run.poses.erase(run.poses.end() - 8, run.poses.end());
  EXPECT_FALSE(judge(run).isGood({})) << "the tracker ended before the robot";
}

TEST(RunReport, RefusesARunWhoseTruthIsUnknown) {
  RecordedRun run = goodRun();
  for (auto& pose : run.truth) pose.stamp += 100 * kSecond;
  const RunReport report = judge(run);
  EXPECT_EQ(report.poses_without_truth, 100u);
  EXPECT_FALSE(report.isGood({}));
}

class RunBag : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = std::filesystem::temp_directory_path() / "sightline_run_XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path() const { return folder_ / "run.bag"; }

  std::filesystem::path folder_;
};

template <class Message>
Message at(int second) {
  Message message;
  message.header.stamp = ros::Time(second);
  return message;
}

TEST_F(RunBag, IsReadWithItsRoomsAndBeams) {
  {
    rosbag::Bag bag(path(), rosbag::bagmode::Write);
    for (int second = 10; second < 13; ++second) {
      const ros::Time now(second);
      bag.write("/scan", now, at<sensor_msgs::LaserScan>(second));
      auto pose = at<geometry_msgs::PoseWithCovarianceStamped>(second);
      pose.pose.pose = toPose(Pose2(second, 1.0, 0.5));
      bag.write("/pose", now, pose);
      bag.write("/ground_truth", now,
                toOdometryMessage({nanoseconds(now), "map", "base_link"},
                                  {Pose2(second, 1.0, 0.5), {}}, {}));
      auto status = at<TrackerStatus>(second);
      status.room = second < 12 ? "office" : "corridor";
      status.walls.resize(2);
      status.walls[0].accepted = true;
      status.walls[0].beams_accepted = 30;
      status.walls[1].beams_accepted = 99;  // not accepted
      bag.write("/tracker_status", now, status);
      bag.write("/lines", now, at<LineSegmentArray>(second));
    }
  }
  const RecordedRun run = readRun(path());
  EXPECT_EQ(run.scans.size(), 3u);
  EXPECT_THAT(run.rooms, testing::ElementsAre("office", "corridor"));
  EXPECT_EQ(run.line_arrays, 3u);
  EXPECT_EQ(run.walls, 3u);
  EXPECT_EQ(run.beams, 90u);
  const RunReport report = judge(run);
  EXPECT_TRUE(report.isGood({}));
  const std::string text = describe(run, report);
  EXPECT_THAT(text, testing::HasSubstr("beams per wall          30.0"));
  EXPECT_THAT(text, testing::HasSubstr("largest pose error      0.0000 m, 0.000 deg"));
}

TEST_F(RunBag, ThatIsNoneOrLacksATopicIsNamed) {
  EXPECT_THROW(readRun(path()), config::Error);
  std::ofstream(path()) << "no bag";
  EXPECT_THROW(readRun(path()), config::Error);
  {
    rosbag::Bag(path(), rosbag::bagmode::Write)
        .write("/scan", ros::Time(1), at<sensor_msgs::LaserScan>(1));
  }
  try {
    readRun(path());
    FAIL();
  } catch (const config::Error& error) {
    EXPECT_EQ(error.key(), "pose");
  }
}

}  // namespace
}  // namespace sightline::bridge
