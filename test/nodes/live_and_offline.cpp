// One recording live, through the graph, and offline, in one process without a graph: every
// estimator gives the same numbers.
#include <cmath>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "nodes/launch.h"
#include "nodes/player.h"
#include "nodes/recorded_drive.h"
#include "nodes/recorder.h"
#include "sightline/LineSegmentArray.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/geometry/angle.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using geometry_msgs::PoseWithCovarianceStamped;
using nav_msgs::Odometry;

constexpr double kDrive = 12.0;     // s
constexpr const char* kRate = "2";  // times real time

template <class Message>
using ByStamp = std::map<std::int64_t, Message>;

template <class Message>
ByStamp<Message> byStamp(const std::vector<Message>& messages) {
  ByStamp<Message> result;
  for (const Message& message : messages) {
    EXPECT_TRUE(result.emplace(bridge::nanoseconds(message.header.stamp), message).second)
        << "two of one stamp";
  }
  return result;
}

template <class Message>
ByStamp<Message> read(const std::string& bag, const std::string& topic) {
  const rosbag::Bag file(bag);
  rosbag::View view(file, rosbag::TopicQuery(std::vector<std::string>{topic, "/" + topic}));
  std::vector<Message> messages;
  for (const rosbag::MessageInstance& message : view) {
    messages.push_back(*message.instantiate<Message>());
  }
  return byStamp(messages);
}

template <class Message>
void expectSamePose(const Message& live, const Message& offline) {
  const auto difference =
      geometry::between(bridge::toPose2(offline.pose.pose), bridge::toPose2(live.pose.pose));
  EXPECT_LT(difference.translation().norm(), 1e-3) << offline.header.stamp;
  EXPECT_LT(std::abs(difference.theta()), geometry::radians(0.01)) << offline.header.stamp;
}

std::vector<double> numbersOf(const LineSegmentArray& array) {
  std::vector<double> numbers;
  for (const LineSegment& line : array.segments) {
    numbers.insert(numbers.end(), {line.rho, line.phi, line.start.x, line.start.y, line.end.x,
                                   line.end.y, line.start_sigma, line.end_sigma, line.chi_square});
    numbers.insert(numbers.end(), line.covariance.begin(), line.covariance.end());
  }
  for (const Arc& arc : array.arcs) {
    numbers.insert(numbers.end(), {arc.centre.x, arc.centre.y, arc.radius});
  }
  return numbers;
}

void expectSameLines(const LineSegmentArray& live, const LineSegmentArray& offline) {
  const auto of_live = numbersOf(live);
  const auto of_offline = numbersOf(offline);
  ASSERT_EQ(of_live.size(), of_offline.size()) << offline.header.stamp;
  for (std::size_t i = 0; i < of_live.size(); ++i) {
    EXPECT_NEAR(of_live[i], of_offline[i], 1e-9) << offline.header.stamp;
  }
}

template <class Message>
void expectSame(const ByStamp<Message>& live, const ByStamp<Message>& offline,
                const std::function<void(const Message&, const Message&)>& expect_same) {
  EXPECT_GT(offline.size(), 100U);
  EXPECT_EQ(live.size(), offline.size());
  for (const auto& [stamp, message] : offline) {
    const auto found = live.find(stamp);
    if (found == live.end()) {
      ADD_FAILURE() << "not live: " << stamp;
    } else {
      expect_same(found->second, message);
    }
  }
}

class LiveAndOffline : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    test::RecordedDrive drive(bag(), SIGHTLINE_SOURCE_DIR "/config/worlds/floor.yaml",
                              SIGHTLINE_SOURCE_DIR "/config/paths/floor_tour.yaml",
                              {-2.2, 4.6, 0.2});
    drive.drive(kDrive);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string bag() { return folder_->path("drive.bag"); }

  void configure(const std::string& settings) {
    config_ = folder_->path("config.yaml");
    std::ofstream(config_) << settings;
    const auto run = test::runProgram(
        "offline", "--config " + config_ + " --out " + folder_->path("out") + " " + bag());
    ASSERT_EQ(run.status, 0) << run.output;
  }
  template <class Message>
  static ByStamp<Message> offline(const std::string& topic) {
    return read<Message>(folder_->path("out/out.bag"), topic);
  }

  // Runs the same live, and ends when there are as many lines as offline, the last to be sent.
  void expectTheSameLive(std::initializer_list<const char*> topics, bool rooms) {
    const test::Recorder<LineSegmentArray> lines("lines");
    const test::Recorder<Odometry> odometry("laser_odom");
    const test::Recorder<PoseWithCovarianceStamped> poses("pose");
    const test::Launch launch("replay.launch delay:=0.5 rate:=" + std::string(kRate) +
                              " play_arguments:='--pause --keep-alive' bag:=" + bag() +
                              " config:=" + config_);
    test::resumePlayer(topics);
    const auto lines_offline = offline<LineSegmentArray>("lines");
    const auto odometry_offline = offline<Odometry>("laser_odom");
    expectSame<LineSegmentArray>(byStamp(lines.atLeast(lines_offline.size())), lines_offline,
                                 expectSameLines);
    expectSame<Odometry>(byStamp(odometry.atLeast(odometry_offline.size())), odometry_offline,
                         expectSamePose<Odometry>);
    if (!rooms) return;
    const auto poses_offline = offline<PoseWithCovarianceStamped>("pose");
    expectSame<PoseWithCovarianceStamped>(byStamp(poses.atLeast(poses_offline.size())),
                                          poses_offline, expectSamePose<PoseWithCovarianceStamped>);
  }

  static inline std::unique_ptr<test::TemporaryFolder> folder_;
  std::string config_;
};

const std::string kRooms =
    "rooms: {map: " SIGHTLINE_SOURCE_DIR
    "/config/rooms/floor.yaml, initial_pose: [-2.2, 4.6, 0.2], initial_sigma: [0.1, 0.05]}\n";

TEST_F(LiveAndOffline, WithTheWheels) {
  configure("scans: [scan]\nuse_imu: false\nodometry: {}\n" + kRooms);
  expectTheSameLive({"/scan", "/tf", "/clock"}, /*rooms=*/true);
}

TEST_F(LiveAndOffline, WithAnInertialSensorAndNoWheels) {
  configure("scans: [scan]\nuse_imu: true\nodometry_source: none\nodometry: {}\n");
  expectTheSameLive({"/scan", "/imu", "/tf_static", "/clock"}, /*rooms=*/false);
}

TEST_F(LiveAndOffline, WithRangeScansOfAHeadThatTurns) {
  configure("range_scans: [range_scan]\nodometry: {}\n" + kRooms);
  expectTheSameLive({"/range_scan", "/imu", "/tf", "/clock"}, /*rooms=*/true);
}

}  // namespace
}  // namespace sightline
