#include <cmath>
#include <limits>
#include <string>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <std_srvs/Trigger.h>
#include <sys/wait.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <Eigen/Eigenvalues>

#include "nodes/recorder.h"
#include "sightline/bridge/imu_conversion.h"
#include "sightline/bridge/odometry_conversion.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/scan_conversion.h"
#include "sightline/bridge/time.h"
#include "sightline/simulation/simulation.h"

namespace sightline {
namespace {

using geometry::Pose2;
using test::Recorder;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

world::World room() {
  world::World world;
  world.add(world::WorldPlate{{}, 0.0, 0});
  const std::vector<Eigen::Vector2d> corners{{-4.0, -3.0}, {5.0, -3.0}, {5.0, 1.0},
                                             {3.5, 1.0},   {3.5, 3.0},  {-4.0, 3.0}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    world::WorldSegment segment;
    segment.segment = {corners[i], corners[(i + 1) % corners.size()]};
    world.add(segment);
  }
  return world;
}

geometry_msgs::TransformStamped mountingMessage(const std::string& base, const std::string& frame,
                                                const simulation::Mounting& mounting) {
  const Eigen::Isometry3d T_base_sensor = mounting.T_base_sensor();
  const Eigen::Quaterniond rotation(T_base_sensor.linear());
  geometry_msgs::TransformStamped message;
  message.header.frame_id = base;
  message.child_frame_id = frame;
  message.transform.translation.x = mounting.x;
  message.transform.translation.y = mounting.y;
  message.transform.translation.z = mounting.z;
  message.transform.rotation.x = rotation.x();
  message.transform.rotation.y = rotation.y();
  message.transform.rotation.z = rotation.z();
  message.transform.rotation.w = rotation.w();
  return message;
}

// A robot on a curve through a room, and the node that is told of its scans. Each test goes on with
// a clock of its own, days after the one before, which starts the odometry anew.
class Robot {
 public:
  struct Kind {
    std::string prefix;  // of topics and frames
    simulation::Mounting mounting;
    bool is_person = false;
    bool has_transform = true;
  };

  explicit Robot(const Kind& kind)
      : kind_(kind),
        simulation_(room(), {}, Pose2(-2.0, -1.0, 0.2), 3),
        scans_(node_.advertise<sensor_msgs::LaserScan>(kind.prefix + "scan", 100)),
        wheels_(node_.advertise<nav_msgs::Odometry>(kind.prefix + "odom", 100)),
        imu_(node_.advertise<sensor_msgs::Imu>(kind.prefix + "imu", 1000)),
        answers_(kind.prefix + "laser_odom") {
    simulation::ScannerProfile profile;
    profile.beams = 361;
    profile.angle_min = geometry::radians(-120.0);
    profile.angle_max = geometry::radians(120.0);
    profile.rate = 10.0;
    if (kind.is_person) simulation_.carrier().walk({});
    simulation_.carrier().addScanner(profile, kind.mounting);
    static ros::Time next_start(1000, 0);
    start_ = next_start;
    next_start += ros::Duration(100000.0);
    if (kind.has_transform) {
      static tf2_ros::StaticTransformBroadcaster broadcaster;
      broadcaster.sendTransform(
          mountingMessage(kind.prefix + "base_link", kind.prefix + "laser", kind.mounting));
    }
    while (ros::ok() && (scans_.getNumSubscribers() < 1 || answers_.publishers() < 1)) {
      ros::WallDuration(0.02).sleep();
    }
    ros::WallDuration(0.5).sleep();  // for the transform, and the other topics
  }

  // Drives until the next scan.
  scan::Scan nextScan() {
    while (true) {
      simulation_.carrier().command({0.5, 0.25});
      const simulation::Outputs outputs = simulation_.step();
      if (sends_wheels) wheels_.publish(wheelMessage());
      if (sends_imu) imu_.publish(imuMessage(outputs.motions.front()));
      if (!outputs.sweeps.empty()) return outputs.sweeps.front().scan;
    }
  }

  sensor_msgs::LaserScan toMessage(scan::Scan scan) const {
    scan.stamp += bridge::nanoseconds(start_);
    scan.frame = kind_.prefix + "laser";
    return bridge::toMessage(scan);
  }

  // What the node says to a scan; the truth of it goes to `truth`.
  nav_msgs::Odometry send(const scan::Scan& scan) {
    truth = truthAt(scan.stamp);
    scans_.publish(toMessage(scan));
    const auto all = answers_.atLeast(++answered_);
    return all.empty() ? nav_msgs::Odometry() : all.back();
  }

  void sendWithoutAnswer(const sensor_msgs::LaserScan& message) { scans_.publish(message); }

  // The first scan starts the odometry anew, because its clock is one of its own.
  nav_msgs::Odometry begin() {
    const auto answer = send(nextScan());
    first_ = bridge::toPose2(answer.pose.pose);
    truth_first_ = truth;
    return answer;
  }

  // Of the pose since begin().
  Pose2 errorOf(const nav_msgs::Odometry& answer) const {
    return geometry::between(geometry::between(truth_first_, truth),
                             geometry::between(first_, bridge::toPose2(answer.pose.pose)));
  }

  Pose2 truthAt(std::int64_t stamp) const { return simulation_.carrier().T_map_base(stamp); }
  std::size_t answers() const { return answers_.count(); }

  Pose2 truth;
  bool sends_wheels = false;
  bool sends_imu = false;

 private:
  ros::Time now() const { return bridge::timeOf(bridge::nanoseconds(start_) + simulation_.time()); }

  nav_msgs::Odometry wheelMessage() const {
    return bridge::toOdometryMessage(
        {bridge::nanoseconds(now()), kind_.prefix + "odom", kind_.prefix + "base_link"},
        {truthAt(simulation_.time()), Eigen::Matrix3d::Zero()}, {});
  }

  sensor_msgs::Imu imuMessage(const simulation::ReportedMotion& motion) const {
    return bridge::toImuMessage(bridge::nanoseconds(now()), kind_.prefix + "base_link",
                                motion.attitude, motion.turn_rate);
  }

  Kind kind_;
  ros::NodeHandle node_;
  simulation::Simulation simulation_;
  ros::Publisher scans_;
  ros::Publisher wheels_;
  ros::Publisher imu_;
  Recorder<nav_msgs::Odometry> answers_;
  ros::Time start_;
  std::size_t answered_ = 0;
  Pose2 first_;
  Pose2 truth_first_;
};

simulation::Mounting aside() {
  simulation::Mounting mounting;
  mounting.x = 0.2;
  mounting.y = 0.1;
  mounting.z = 0.4;
  mounting.yaw = 0.3;
  return mounting;
}

// What a diagnostic of the node says last under a key.
std::string diagnosed(const Recorder<diagnostic_msgs::DiagnosticArray>& diagnostics,
                      const std::string& name, const std::string& key) {
  std::string found;
  for (const auto& array : diagnostics.all()) {
    for (const auto& status : array.status) {
      if (status.name != name) continue;
      for (const auto& value : status.values) {
        if (value.key == key) found = value.value;
      }
    }
  }
  return found;
}

TEST(LaserOdometryNode, FollowsTheRobotWithOneAnswerToAScan) {
  Robot robot({"", aside()});
  robot.begin();
  for (int i = 0; i < 60; ++i) {
    const auto scan = robot.nextScan();
    const auto answer = robot.send(scan);
    EXPECT_EQ(answer.header.stamp, robot.toMessage(scan).header.stamp);
    EXPECT_EQ(answer.header.frame_id, "odom");
    EXPECT_EQ(answer.child_frame_id, "base_link");
    const Pose2 error = robot.errorOf(answer);
    EXPECT_LT(error.translation().norm(), 0.04);
    EXPECT_LT(std::abs(error.theta()), 0.015);
    if (i < 20) continue;  // it has come to speed by then
    EXPECT_NEAR(answer.twist.twist.linear.x, 0.5, 0.2);
    EXPECT_NEAR(answer.twist.twist.angular.z, 0.25, 0.2);
    for (const auto& covariance : {answer.pose.covariance, answer.twist.covariance}) {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
          bridge::toCovariance3(covariance));
      EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
    }
  }
  EXPECT_EQ(robot.answers(), 61U);
}

TEST(LaserOdometryNode, AScannerOnItsHeadSeesTheSameAndOwnsTheTransform) {
  auto mounting = aside();
  mounting.roll = geometry::kPi;
  Recorder<tf2_msgs::TFMessage> transforms("/tf");
  Robot robot({"hanging/", mounting});
  robot.begin();
  nav_msgs::Odometry answer;
  for (int i = 0; i < 40; ++i) {
    answer = robot.send(robot.nextScan());
    EXPECT_LT(robot.errorOf(answer).translation().norm(), 0.04);
    EXPECT_LT(std::abs(robot.errorOf(answer).theta()), 0.015);
  }
  EXPECT_LT(0.2, bridge::toPose2(answer.pose.pose).theta()) << "it went to the left";
  for (const auto& message : transforms.atLeast(41)) {
    const auto& transform = message.transforms.front();
    ASSERT_EQ(transform.header.frame_id, "hanging/odom") << "nobody else publishes one";
    EXPECT_EQ(transform.child_frame_id, "hanging/base_link");
    if (transform.header.stamp != answer.header.stamp) continue;
    EXPECT_EQ(transform.transform.translation.x, answer.pose.pose.position.x);
    EXPECT_EQ(transform.transform.rotation.z, answer.pose.pose.orientation.z);
  }
}

TEST(LaserOdometryNode, BadScansAreDroppedAndCounted) {
  Recorder<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  Robot robot({"", aside()});
  const auto dropped = [&] {
    const auto count = diagnosed(diagnostics, "laser_odometry: input /scan", "dropped");
    return count.empty() ? 0 : std::stoi(count);
  };
  robot.begin();
  while (ros::ok() && diagnosed(diagnostics, "laser_odometry: input /scan", "dropped").empty()) {
    ros::WallDuration(0.05).sleep();
  }
  const int before = dropped();
  const auto good = robot.toMessage(robot.nextScan());
  auto no_beams = good;
  no_beams.ranges.clear();
  auto no_increment = good;
  no_increment.angle_increment = 0.0F;
  auto nan_increment = good;
  nan_increment.time_increment = kNan;
  auto limits = good;
  limits.range_max = -1.0F;
  auto no_stamp = good;
  no_stamp.header.stamp = ros::Time();
  auto nowhere = good;
  nowhere.header.frame_id = "nobody_knows";
  auto no_frame = good;
  no_frame.header.frame_id.clear();
  for (const auto& bad :
       {no_beams, no_increment, nan_increment, limits, no_stamp, nowhere, no_frame}) {
    robot.sendWithoutAnswer(bad);
  }
  for (int i = 0; i < 10; ++i) {
    EXPECT_LT(robot.errorOf(robot.send(robot.nextScan())).translation().norm(), 0.04);
  }
  for (int i = 0; i < 200 && dropped() < before + 7; ++i) ros::WallDuration(0.05).sleep();
  EXPECT_EQ(dropped(), before + 7);
}

TEST(LaserOdometryNode, ScansWithHolesAndFewerBeamsAreMatchedAllTheSame) {
  Robot robot({"", aside()});
  robot.begin();
  for (int i = 0; i < 20; ++i) {
    auto scan = robot.nextScan();
    for (std::size_t beam = static_cast<std::size_t>(i); beam < scan.beams(); beam += 7) {
      scan.setKind(beam, i % 2 == 0 ? scan::ReturnKind::kInvalid : scan::ReturnKind::kNothing);
    }
    EXPECT_LT(robot.errorOf(robot.send(scan)).translation().norm(), 0.05);
  }
}

TEST(LaserOdometryNode, ResetStartsAnew) {
  Robot robot({"", aside()});
  robot.begin();
  for (int i = 0; i < 20; ++i) robot.send(robot.nextScan());
  std_srvs::Trigger call;
  ASSERT_TRUE(ros::service::call("laser_odometry/reset", call));
  EXPECT_TRUE(call.response.success);
  const auto answer = robot.begin();
  EXPECT_EQ(bridge::toPose2(answer.pose.pose).coordinates(), Eigen::Vector3d::Zero());
  EXPECT_EQ(answer.pose.covariance[0], 0.0);
  for (int i = 0; i < 10; ++i) {
    EXPECT_LT(robot.errorOf(robot.send(robot.nextScan())).translation().norm(), 0.04);
  }
}

TEST(LaserOdometryNode, WheelsBringItThroughScansThatSayNothing) {
  Robot robot({"", aside()});
  robot.sends_wheels = true;
  std_srvs::Trigger call;
  ASSERT_TRUE(ros::service::call("laser_odometry/reset", call));
  robot.nextScan();
  ros::WallDuration(0.3).sleep();  // for the node to know of the wheels before the first scan
  const auto begun = robot.begin();
  EXPECT_LT(geometry::between(robot.truth, bridge::toPose2(begun.pose.pose)).translation().norm(),
            1e-3)
      << "it begins where the wheels are";
  for (int i = 0; i < 40; ++i) {
    auto scan = robot.nextScan();
    for (std::size_t beam = 0; beam < scan.beams() && i > 10 && i < 20; ++beam) {
      scan.setKind(beam, scan::ReturnKind::kNothing);
    }
    const auto answer = robot.send(scan);
    EXPECT_LT(robot.errorOf(answer).translation().norm(), 0.05) << i;
  }
}

TEST(LaserOdometryNode, ClockSetBackDoesNotStopIt) {
  Robot later({"", aside()});
  Robot robot({"", aside()});
  robot.begin();
  robot.send(robot.nextScan());
  later.begin();
  const auto stamp = later.send(later.nextScan()).header.stamp;
  EXPECT_NE(stamp, ros::Time());
}

TEST(WornLaserOdometry, FollowsAPersonAndLeavesOutTheFloor) {
  Recorder<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  simulation::Mounting mounting;
  mounting.z = 1.2;
  Robot robot({"worn/", mounting, /*is_person=*/true, /*has_transform=*/false});
  robot.sends_imu = true;
  robot.begin();
  for (int i = 0; i < 60; ++i) {
    const auto answer = robot.send(robot.nextScan());
    EXPECT_LT(robot.errorOf(answer).translation().norm(), 0.08);
    EXPECT_LT(std::abs(robot.errorOf(answer).theta()), 0.02);
  }
  const std::string name = "worn/laser_odometry: odometry";
  for (int i = 0; i < 200 && diagnosed(diagnostics, name, "mounting").empty(); ++i) {
    ros::WallDuration(0.05).sleep();
  }
  EXPECT_EQ(diagnosed(diagnostics, name, "mounting"), "none: the scanner is the base");
}

TEST(NodeletOfLaserOdometry, AnswersAsTheNodeDoes) {
  Robot robot({"nodelets/", {}, false, /*has_transform=*/false});
  robot.begin();
  for (int i = 0; i < 10; ++i) {
    EXPECT_LT(robot.errorOf(robot.send(robot.nextScan())).translation().norm(), 0.04);
  }
}

// Ends of a node that is given nonsense.
int statusOf(const std::string& arguments) {
  const int status = std::system(
      ("rosrun sightline laser_odometry __name:=bad " + arguments + " > /dev/null 2>&1").c_str());
  ros::param::del("/bad");
  return WEXITSTATUS(status);
}

TEST(LaserOdometryParameters, OutOfRangeOrOfTheWrongTypeEndTheNode) {
  EXPECT_EQ(statusOf("_odometry/carrier/max_speed:=-1"), 1);
  EXPECT_EQ(statusOf("_odometry/method:=guess"), 1);
  EXPECT_EQ(statusOf("_publish_tf:=perhaps"), 1);
}

}  // namespace
}  // namespace sightline
