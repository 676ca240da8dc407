#include <filesystem>

#include <gmock/gmock.h>

#include "robot_bag.h"
#include "sightline/geometry/angle.h"
#include "sightline/pipeline/estimators_config.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class CheckBag : public testing::Test {
 protected:
  test::ProgramResult check(const test::RobotBag& robot, const std::string& options = "") {
    robot.write(folder_.path("a.bag"));
    return test::runProgram("check_bag", folder_.path("a.bag") + " " + options);
  }

  test::TemporaryFolder folder_;
};

TEST_F(CheckBag, FindsNothingAmissWhereNothingIs) {
  const auto result =
      check({}, "--write-config " + folder_.path("a.yaml") + " --plot " + folder_.path("a.png"));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output,
              AllOf(HasSubstr("198 scans, 10.00 Hz, 360 beams"), HasSubstr("0 errors, 0 warnings"),
                    HasSubstr("base_link -> laser, static")));
  EXPECT_TRUE(std::filesystem::exists(folder_.path("a.png")));
  const auto offline =
      test::runProgram("offline", "--config " + folder_.path("a.yaml") + " " +
                                      folder_.path("a.bag") + " --out " + folder_.path("out"));
  EXPECT_EQ(offline.status, 0) << offline.output;
  EXPECT_THAT(offline.output, HasSubstr("odometry: 198 of 198 scans have a pose"));
}

TEST_F(CheckBag, FindsScansThatComeLate) {
  test::RobotBag robot;
  robot.scan = [](sensor_msgs::LaserScan& scan, double) {
    scan.header.stamp += ros::Duration(0.12);
  };
  const auto result = check(robot);
  EXPECT_EQ(result.status, 4) << result.output;
  EXPECT_THAT(result.output,
              AllOf(HasSubstr("behind the odometry's"), HasSubstr("`time_offset: -0.1")));
}

TEST_F(CheckBag, FindsMissesThatComeAsRanges) {
  test::RobotBag robot;
  robot.scan = [](sensor_msgs::LaserScan& scan, double) {
    for (std::size_t i = 0; i < scan.ranges.size(); i += 10) scan.ranges[i] = 11.95F;
  };
  EXPECT_THAT(check(robot).output, HasSubstr("beams without a return come as 11.950 m"));
}

TEST_F(CheckBag, FindsJumpsOfTheOdometry) {
  test::RobotBag robot;
  robot.transform = [](geometry_msgs::TransformStamped& transform, double time) {
    if (time > 10.0) transform.transform.translation.x += 30.0;
  };
  const auto result = check(robot);
  EXPECT_THAT(result.output, HasSubstr("jump"));
  EXPECT_EQ(result.status, 4) << result.output;
}

TEST_F(CheckBag, FindsAScannerThatIsNotLevel) {
  test::RobotBag robot;
  robot.mount = [](geometry_msgs::TransformStamped& mounting) {
    auto& rotation = mounting.transform.rotation;
    rotation.w = rotation.y = -0.5;
    rotation.x = rotation.z = 0.5;
    rotation.w = -0.5;
  };
  const auto result = check(robot);
  EXPECT_EQ(result.status, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("tilted by 90 degrees"));
}

TEST_F(CheckBag, SaysThatNoTransformReachesTheScanner) {
  test::RobotBag robot;
  robot.scan = [](sensor_msgs::LaserScan& scan, double) { scan.header.frame_id = "laser_link"; };
  EXPECT_THAT(check(robot).output, HasSubstr("no transform from base_link to laser_link"));
}

TEST_F(CheckBag, FindsTheRobotsOwnBodyAndMasksIt) {
  test::RobotBag robot;
  robot.scan = [](sensor_msgs::LaserScan& scan, double) {
    for (std::size_t i = 175; i < 186; ++i) scan.ranges[i] = 0.3F;
  };
  const auto result = check(robot, "--write-config " + folder_.path("a.yaml"));
  EXPECT_THAT(result.output, HasSubstr("beams 175 to 185"));
  const auto settings = pipeline::EstimatorsConfig::readFile(folder_.path("a.yaml"));
  const auto sectors = settings.input.feed.body.at("laser");
  ASSERT_EQ(sectors.size(), 2U);
  EXPECT_NEAR(sectors[0], geometry::radians(-5.5), 0.002);
  EXPECT_NEAR(sectors[1], geometry::radians(5.5), 0.002);
}

TEST_F(CheckBag, RefusesWhatIsNoBag) {
  const auto result = test::runProgram("check_bag", folder_.write("b.bag", "no bag"));
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("b.bag"));
}

}  // namespace
}  // namespace sightline
