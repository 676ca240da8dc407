// The log fr079 live, through the graph, against the same log in one process with no graph.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include "nodes/launch.h"
#include "nodes/player.h"
#include "nodes/recorder.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/geometry/angle.h"
#include "sightline/logs/trajectory.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using geometry_msgs::PoseWithCovarianceStamped;
using test::Launch;
using test::Recorder;
using test::runProgram;

constexpr const char* kConfig = SIGHTLINE_SOURCE_DIR "/config/offline/fr079.yaml";
const ros::Duration kStretch(120.0);
// More is played than compared: the last scans wait for odometry that comes after them.
constexpr const char* kPlayed = "123";  // s
constexpr const char* kRate = "6";      // times real time

using Poses = std::map<std::int64_t, geometry::Pose2>;  // by stamp [ns]

std::set<std::int64_t> stampsOf(const Poses& poses) {
  std::set<std::int64_t> stamps;
  for (const auto& [stamp, pose] : poses) stamps.insert(stamps.end(), stamp);
  return stamps;
}

class Freiburg : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("SIGHTLINE_DATA");
    const std::filesystem::path log = std::filesystem::path(data ? data : "") / "fr079.clf.gz";
    if (!data || !std::filesystem::exists(log)) {
      GTEST_SKIP() << "SIGHTLINE_DATA holds no fr079.clf.gz";
    }
    const auto conversion = runProgram(
        "carmen_to_bag", log.string() + " " + bag_ + " --reverse-from-tv --odometry-delay 0.12");
    ASSERT_EQ(conversion.status, 0) << conversion.output;
    readScans();
  }

  void readScans() {
    const rosbag::Bag bag(bag_);
    rosbag::View all(bag);
    end_ = bridge::nanoseconds(all.getBeginTime() + kStretch);
    rosbag::View scans(bag, rosbag::TopicQuery("/scan"));
    for (const rosbag::MessageInstance& instance : scans) {
      const auto stamp =
          bridge::nanoseconds(instance.instantiate<sensor_msgs::LaserScan>()->header.stamp);
      if (stamp < end_) scans_.insert(stamp);
    }
  }

  Poses posesOffline() {
    const auto tracking =
        runProgram("offline", std::string("--config ") + kConfig + " " + bag_ + " --out " +
                                  folder_.path("out") + " --nodes rooms");
    EXPECT_EQ(tracking.status, 0) << tracking.output;
    Poses poses;
    for (const auto& timed : logs::readTrajectory(folder_.path("out/rooms.tum"))) {
      if (timed.stamp < end_) poses.emplace(timed.stamp, timed.pose);
    }
    return poses;
  }

  // The player waits until everything listens, however long a busy machine takes to start it.
  Poses posesLive(std::size_t wanted) {
    const Recorder<PoseWithCovarianceStamped> recorder("pose");
    const Launch launch(std::string("replay.launch delay:=0.5 rate:=") + kRate +
                        " play_arguments:='--pause --keep-alive --duration=" + kPlayed +
                        "' bag:=" + bag_ + " config:=" + kConfig);
    test::resumePlayer({"/scan", "/tf", "/clock"});
    Poses poses;
    for (const auto& message : recorder.atLeast(wanted)) {
      const auto stamp = bridge::nanoseconds(message.header.stamp);
      if (stamp < end_) poses.emplace(stamp, bridge::toPose2(message.pose.pose));
    }
    return poses;
  }

  test::TemporaryFolder folder_;
  const std::string bag_ = folder_.path("in.bag");
  std::int64_t end_ = 0;          // [ns] of the stretch that is compared
  std::set<std::int64_t> scans_;  // stamps [ns], up to there
};

TEST_F(Freiburg, LivePosesAreThoseOfOffline) {
  const Poses offline = posesOffline();
  ASSERT_FALSE(offline.empty());
  const Poses live = posesLive(offline.size());
  ASSERT_FALSE(live.empty());
  scans_.erase(scans_.begin(), scans_.lower_bound(offline.begin()->first));  // before the odometry
  EXPECT_EQ(stampsOf(offline), scans_);
  EXPECT_EQ(stampsOf(live), scans_);
  for (const auto& [stamp, pose] : offline) {
    const auto found = live.find(stamp);
    if (found == live.end()) continue;
    const geometry::Pose2 difference = geometry::between(pose, found->second);
    EXPECT_LT(std::hypot(difference.x(), difference.y()), 1e-3) << stamp;
    EXPECT_LT(std::abs(difference.theta()), geometry::radians(0.01)) << stamp;
  }
}

}  // namespace
}  // namespace sightline
