#include <filesystem>
#include <functional>

#include <geometry_msgs/TransformStamped.h>
#include <gmock/gmock.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using geometry::Pose2;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// A robot that swerves through a square room and says so on `scan`, `odom` and tf.
class CheckBag : public testing::Test {
 protected:
  static constexpr std::int64_t kFirstStamp = 1'000'000'000'000;
  static constexpr double kHalfRoom = 3.0;  // m

  struct Faults {
    double late = 0.0;            // of the scans' stamps [s]
    std::string frame = "laser";  // of the scans
    double miss = 0.0;            // range of a tenth of the beams [m]; 0: none
    bool jumps = false;           // of the odometry, once
    Eigen::Quaterniond mounting = Eigen::Quaterniond::Identity();
  };

  static Pose2 robotAt(double time) {
    return {std::sin(0.5 * time), 0.4 * std::sin(0.9 * time), 0.8 * std::sin(1.3 * time)};
  }

  static sensor_msgs::LaserScan scanAt(double time, const Faults& faults) {
    sensor_msgs::LaserScan scan;
    scan.header.frame_id = faults.frame;
    scan.header.stamp = stampOf(time + faults.late);
    scan.angle_min = -3.1F;
    scan.angle_max = 3.1F;
    scan.angle_increment = 6.2F / 359.0F;
    scan.range_min = 0.1F;
    scan.range_max = 8.0F;
    for (int i = 0; i < 360; ++i) {
      scan.ranges.push_back(
          rangeFrom(robotAt(time), scan.angle_min + static_cast<float>(i) * scan.angle_increment));
      if (faults.miss > 0.0 && i % 10 == 0) scan.ranges.back() = static_cast<float>(faults.miss);
    }
    return scan;
  }

  // To the nearest of four walls and of a box that makes the room one of its kind.
  static float rangeFrom(const Pose2& robot, double beam) {
    const double angle = robot.theta() + beam;
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    double range = 1e9;
    const auto meet = [&](int axis, double wall, double from, double to) {
      const double r = (wall - robot.translation()[axis]) / along[axis];
      const double across = robot.translation()[1 - axis] + r * along[1 - axis];
      if (r > 0.0 && across >= from && across <= to) range = std::min(range, r);
    };
    for (const double wall : {-kHalfRoom, kHalfRoom}) {
      meet(0, wall, -kHalfRoom, kHalfRoom);
      meet(1, wall, -kHalfRoom, kHalfRoom);
    }
    meet(0, 2.2, -3.0, -1.0);
    meet(1, -1.0, 2.2, 3.0);
    return static_cast<float>(range);
  }

  static ros::Time stampOf(double time) {
    return bridge::timeOf(kFirstStamp + std::llround(1e9 * time));
  }

  test::ProgramResult check(const Faults& faults, const std::string& options = "") {
    write(faults);
    return test::runProgram("check_bag", folder_.path("a.bag") + " " + options);
  }

  void write(const Faults& faults) {
    rosbag::Bag bag(folder_.path("a.bag"), rosbag::bagmode::Write);
    tf2_msgs::TFMessage mounting;
    Eigen::Isometry3d T_base_laser = Eigen::Isometry3d::Identity();
    T_base_laser.linear() = faults.mounting.toRotationMatrix();
    mounting.transforms = {bridge::toTransformMessage("base_link", "laser", 0, T_base_laser)};
    bag.write("/tf_static", stampOf(0.0), mounting);
    for (int i = 0; i < 1000; ++i) {
      const double time = 0.02 * i;
      Pose2 pose = robotAt(time);
      if (faults.jumps && i > 500) pose = {pose.x() + 30.0, pose.y(), pose.theta()};
      tf2_msgs::TFMessage message;
      message.transforms = {
          bridge::toTransformMessage("odom", "base_link", kFirstStamp + i * 20'000'000L, pose)};
      bag.write("/tf", stampOf(time), message);
      if (i % 5 == 0) bag.write("/scan", stampOf(time), scanAt(time, faults));
    }
  }

  test::TemporaryFolder folder_;
};

TEST_F(CheckBag, FindsNothingAmissWhereNothingIs) {
  const auto result =
      check({}, "--write-config " + folder_.path("a.yaml") + " --plot " + folder_.path("a.png"));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output,
              AllOf(HasSubstr("200 scans, 10.00 Hz, 360 beams"), HasSubstr("0 errors, 0 warnings"),
                    HasSubstr("base_link -> laser, static")));
  EXPECT_TRUE(std::filesystem::exists(folder_.path("a.png")));
  const auto offline =
      test::runProgram("offline", "--config " + folder_.path("a.yaml") + " " +
                                      folder_.path("a.bag") + " --out " + folder_.path("out"));
  EXPECT_EQ(offline.status, 0) << offline.output;
  EXPECT_THAT(offline.output, HasSubstr("odometry: 200 of 200 scans have a pose"));
}

TEST_F(CheckBag, FindsScansThatComeLate) {
  Faults faults;
  faults.late = 0.12;
  const auto result = check(faults);
  EXPECT_EQ(result.status, 4) << result.output;
  EXPECT_THAT(result.output,
              AllOf(HasSubstr("behind the odometry's"), HasSubstr("`time_offset: -0.1")));
}

TEST_F(CheckBag, FindsMissesThatComeAsRanges) {
  Faults faults;
  faults.miss = 7.95;
  EXPECT_THAT(check(faults).output, HasSubstr("beams without a return come as ranges"));
}

TEST_F(CheckBag, FindsJumpsOfTheOdometry) {
  Faults faults;
  faults.jumps = true;
  const auto result = check(faults);
  EXPECT_THAT(result.output, HasSubstr("jump"));
  EXPECT_EQ(result.status, 4) << result.output;
}

TEST_F(CheckBag, FindsAScannerThatIsNotLevel) {
  Faults faults;
  faults.mounting = Eigen::Quaterniond(-0.5, 0.5, -0.5, 0.5);
  const auto result = check(faults);
  EXPECT_EQ(result.status, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("90 degrees from level"));
}

TEST_F(CheckBag, SaysThatNoTransformReachesTheScanner) {
  Faults faults;
  faults.frame = "laser_link";
  EXPECT_THAT(check(faults).output, HasSubstr("no transform from base_link to laser_link"));
}

TEST_F(CheckBag, RefusesWhatIsNoBag) {
  const auto result = test::runProgram("check_bag", folder_.write("b.bag", "no bag"));
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("b.bag"));
}

}  // namespace
}  // namespace sightline
