#include <filesystem>

#include <gmock/gmock.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "carmen_room.h"
#include "sightline/logs/trajectory_error.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using test::ProgramResult;
using test::runProgram;
using testing::HasSubstr;
using testing::Not;

constexpr int kScans = 60;
constexpr const char* kConfig = "rooms:\n  map: rooms.yaml\n  initial_pose: [-1.45, -1.05, 0.22]\n";

// The log of a room, as a bag, with the settings for it.
class OfflineTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("rooms.yaml", test::kRoomMap);
    folder_.write("a.yaml", kConfig);
    const std::string log = folder_.write("a.clf", test::carmenRoomLog(kScans));
    ASSERT_EQ(runProgram("carmen_to_bag", log + " " + folder_.path("a.bag")).status, 0);
  }

  ProgramResult run(const std::string& options = "") {
    return runProgram("offline", "--config " + folder_.path("a.yaml") + " " +
                                     folder_.path("a.bag") + " --out " + folder_.path("out") + " " +
                                     options);
  }

  std::map<std::string, std::size_t> topicsOfResult() {
    std::map<std::string, std::size_t> topics;
    rosbag::Bag bag(folder_.path("out/out.bag"));
    rosbag::View view(bag);
    for (const rosbag::MessageInstance& message : view) ++topics[message.getTopic()];
    return topics;
  }

  static geometry::Pose2 robotAt(const geometry::StampedPose2& timed) {
    return test::carmenRobotAt(1e-9 * static_cast<double>(timed.stamp) - 100.0);
  }

  test::TemporaryFolder folder_;
};

TEST_F(OfflineTest, TracksTheRobotInTheRoom) {
  const auto result = run();
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("rooms: 60 of 60 scans have a pose, 0 of them while lost"));
  EXPECT_THAT(result.output, HasSubstr("times real time"));
  const auto trajectory = logs::readTrajectory(folder_.path("out/rooms.tum"));
  ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(kScans));
  logs::Trajectory truth;
  for (const geometry::StampedPose2& timed : trajectory) {
    truth.push_back(
        {timed.stamp, test::carmenRobotAt(1e-9 * static_cast<double>(timed.stamp) - 100.0)});
  }
  const auto errors = logs::compareWithTruth(trajectory, truth);
  EXPECT_LT(errors.absolute->translation.mean, 0.01);
  EXPECT_LT(errors.absolute->rotation.mean, 0.2);
}

TEST_F(OfflineTest, WritesThePathOfTheWholeRecording) {
  const auto result = run("--nodes map");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("map: 60 scans, "));
  const auto trajectory = logs::readTrajectory(folder_.path("out/map.tum"));
  ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(kScans));
  for (const geometry::StampedPose2& timed : trajectory) {
    EXPECT_LT((timed.pose.translation() - robotAt(timed).translation()).norm(), 0.01);
  }
}

TEST_F(OfflineTest, WritesWhatRvizNeeds) {
  ASSERT_EQ(run().status, 0);
  const auto topics = topicsOfResult();
  EXPECT_EQ(topics.at("/scan"), 60U);
  EXPECT_EQ(topics.at("/lines"), 60U);
  EXPECT_EQ(topics.at("/pose"), 60U);
  EXPECT_EQ(topics.at("/tracker_status"), 60U);
  EXPECT_EQ(topics.at("/map"), 1U);
  EXPECT_EQ(topics.at("/tf"), 120U + 60U);
}

TEST_F(OfflineTest, GivesTheSameResultEveryTime) {
  const auto contentOf = [](const std::string& path) {
    std::ifstream file(path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  ASSERT_EQ(run().status, 0);
  const std::string first = contentOf(folder_.path("out/rooms.tum"));
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(contentOf(folder_.path("out/rooms.tum")), first);
}

TEST_F(OfflineTest, RunsOnlyWhatIsAskedFor) {
  const auto result = run("--nodes lines --no-wheels");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output, Not(HasSubstr("rooms")));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out/rooms.tum")));
  EXPECT_EQ(topicsOfResult().count("/pose"), 0U);
}

TEST_F(OfflineTest, FollowsTheRobotByItsScansAlone) {
  const auto result = run("--nodes odometry --no-wheels");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("odometry: 60 of 60 scans have a pose, 0 of them flagged, "
                                       "0 with the wheels as prior"));
  const auto trajectory = logs::readTrajectory(folder_.path("out/odometry.tum"));
  ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(kScans));
  const geometry::Pose2 T_map_odom = robotAt(trajectory.front());
  for (const geometry::StampedPose2& timed : trajectory) {
    const geometry::Pose2 error = geometry::between(robotAt(timed), T_map_odom * timed.pose);
    EXPECT_LT(error.translation().norm(), 0.03);
    EXPECT_LT(std::abs(error.theta()), 0.01);
  }
  EXPECT_EQ(topicsOfResult().at("/laser_odom"), 60U);
}

TEST_F(OfflineTest, TracksRoomsByScansAlone) {
  const auto result = run("--nodes rooms,odometry --no-wheels");
  EXPECT_EQ(result.status, 0) << result.output;
  const auto trajectory = logs::readTrajectory(folder_.path("out/rooms.tum"));
  ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(kScans));
  for (const geometry::StampedPose2& timed : trajectory) {
    const geometry::Pose2 error = geometry::between(robotAt(timed), timed.pose);
    EXPECT_LT(error.translation().norm(), 0.03);
    EXPECT_LT(std::abs(error.theta()), 0.01);
  }
}

TEST_F(OfflineTest, BeginsWhereTheWheelsAre) {
  const auto result = run("--nodes odometry");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("60 with the wheels as prior"));
  EXPECT_EQ(logs::readTrajectory(folder_.path("out/odometry.tum")).size(), 60U);
}

TEST_F(OfflineTest, RunsOdometryWhereTheSettingsAskForIt) {
  folder_.write("a.yaml", "odometry: {method: histogram}\n");
  const auto result = run();
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("lines: "));
  EXPECT_THAT(result.output, HasSubstr("odometry: 60 of 60"));
}

TEST_F(OfflineTest, RefusesWhatItCannotDo) {
  const auto refusal = [this](const std::string& options) {
    const auto result = run(options);
    EXPECT_EQ(result.status, 2) << options;
    return result.output;
  };
  EXPECT_THAT(refusal("--nodes lines,targets"), HasSubstr("targets runs alone"));
  EXPECT_THAT(refusal("--nodes lanes"), HasSubstr("no node lanes"));
  EXPECT_THAT(refusal("--nodes rooms --no-wheels"), HasSubstr("rooms without odometry"));
}

TEST_F(OfflineTest, SaysWhatIsWrongWithItsInput) {
  const auto fault = [this]() {
    const auto result = run();
    EXPECT_EQ(result.status, 1);
    return result.output;
  };
  folder_.write("a.yaml", "scans: [front]\n");
  EXPECT_THAT(fault(), HasSubstr("no scans on /front; there are: /scan"));
  folder_.write("a.yaml", "rooms: {map: none.yaml, initial_pose: [0, 0, 0]}\n");
  EXPECT_THAT(fault(), HasSubstr("none.yaml: no such file"));
  folder_.write("a.yaml", kConfig);
  folder_.write("a.bag", "not a bag");
  EXPECT_THAT(fault(), HasSubstr("a.bag"));
}

TEST_F(OfflineTest, DoesNotWriteOverItsInput) {
  std::filesystem::create_directory(folder_.path("out"));
  std::filesystem::copy(folder_.path("a.bag"), folder_.path("out/out.bag"));
  const auto result =
      runProgram("offline", "--config " + folder_.path("a.yaml") + " " +
                                folder_.path("out/out.bag") + " --out " + folder_.path("out"));
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("is where the result would go"));
  EXPECT_EQ(std::filesystem::file_size(folder_.path("out/out.bag")),
            std::filesystem::file_size(folder_.path("a.bag")));
}

}  // namespace
}  // namespace sightline
