// What drivers do to whole scans, through `offline`: mirror them, repeat them, split a view among
// two.
#include <cmath>

#include <gmock/gmock.h>

#include "robot_edits.h"

namespace sightline {
namespace {

using test::RobotInput;
using test::RobotRun;
using test::runOffline;
using testing::HasSubstr;
using testing::Not;

TEST(OtherDrivers, BeamsInTheOppositeSenseAreNamed) {
  for (const RobotInput& input : {test::mirroredScans(), test::onTopic(test::mirroredScans())}) {
    const RobotRun run = runOffline(input);
    EXPECT_THAT(run.output, HasSubstr("its scans turn against the odometry"));
    EXPECT_FALSE(run.isSilentlyWrong()) << run.output << run.rooms_worst.position;
    EXPECT_GT(run.flagged, 50U);
  }
  EXPECT_THAT(runOffline(test::asItShouldBe()).output, Not(HasSubstr("turn against")));
}

TEST(OtherDrivers, LateStampsAreFoundByTurnsAndMadeGood) {
  const RobotInput right = test::turningToAndFro();
  EXPECT_THAT(runOffline(right).output, Not(HasSubstr("as turns show")));
  for (const double late : {0.1, -0.08}) {
    const RobotRun run = runOffline(test::lateStamps(late));
    EXPECT_THAT(run.output, HasSubstr("as turns show, by the odometry's clock its first beam is"));
    EXPECT_LT(run.rooms_worst.position, 0.02) << run.output;
    EXPECT_LT(run.rooms_worst.heading, 0.5) << late;
    EXPECT_LT(run.odometry_end.heading, 0.5) << late;
  }
  RobotInput left = test::lateStamps(0.1);
  left.settings = "correct_timing: false\n";
  EXPECT_THAT(runOffline(left).output, HasSubstr("left so by correct_timing"));
}

TEST(OtherDrivers, SweepsOfAnotherDurationOrOrderAreFoundAndMadeGood) {
  for (const double factor : {-1.0, 0.0, 0.05}) {
    const RobotRun run = runOffline(test::otherSweeps(factor));
    EXPECT_THAT(run.output, HasSubstr("from its first beam to its last 0.")) << factor;
    EXPECT_FALSE(run.isSilentlyWrong())
        << "at the start the room's twin looks as likely: " << factor;
    EXPECT_LT(run.odometry_end.position, 0.03) << run.output;
    EXPECT_LT(run.odometry_end.heading, 1.0) << factor;
  }
}

TEST(OtherDrivers, RepeatedScansAreDroppedByName) {
  const RobotRun run = runOffline(test::repeatedScans(8.0, 10.0));
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("20 of 198 scans dropped: the ranges of the scan before it"));
  EXPECT_LT(run.rooms_worst.position, 0.05);
  EXPECT_LT(run.odometry_end.position, 0.05) << run.output;
  EXPECT_EQ(run.room_poses, 178U);
}

// At rest a scanner whose noise is lost in its counts gives the same scan for ever, and rightly so.
TEST(OtherDrivers, EqualScansOfAScannerWithoutNoiseAreNoRepetition) {
  const auto count = [](sensor_msgs::LaserScan& scan, double) {
    for (float& range : scan.ranges) range = 0.01F * std::round(100.0F * range);
  };
  RobotInput input = test::asItShouldBe();
  input.bag.noise = 1e-6;
  input.bag.moves = false;
  input.bag.scan = count;
  const RobotRun run = runOffline(input);
  EXPECT_LT(run.rooms_worst.position, 0.05);
  EXPECT_LT(run.odometry_end.position, 0.05);
  EXPECT_EQ(run.room_poses, 198U);
  input = test::repeatedScans(8.0, 10.0);
  input.bag.noise = 1e-6;
  input.bag.scan = [count, repeat = input.bag.scan](sensor_msgs::LaserScan& scan, double time) {
    count(scan, time);
    repeat(scan, time);
  };
  EXPECT_THAT(runOffline(input).output, HasSubstr("scans dropped: the ranges of the scan before"))
      << "by the wheels";
}

TEST(OtherDrivers, OdometryOfTwoScannersIsOne) {
  RobotInput input = test::asItShouldBe();
  input.name = "front_and_rear";
  input.settings = "scans: [scan, rear]\n";
  input.options = "--nodes odometry --no-wheels";
  test::RobotBag& front = input.bag;
  front.beams = 181;
  front.angle_min = -geometry::kPi / 2.0;
  front.angle_max = geometry::kPi / 2.0;
  front.range_max = 2.5;
  test::RobotBag rear = front;
  rear.scan_topic = "/rear";
  rear.laser = "rear_laser";
  rear.mounting = {-0.2, 0.05, 0.3, 0.0, 0.0, geometry::kPi};
  rear.noise = 0.02;
  rear.odometry_on_tf = false;
  rear.static_topic = "/tf_static";
  const test::TemporaryFolder folder;
  front.write(folder.path("front.bag"));
  rear.write(folder.path("rear.bag"));
  const std::string bags = " " + folder.path("front.bag") + " " + folder.path("rear.bag");
  const RobotRun run = runOffline(input, folder, bags);
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_EQ(run.odometry_poses, 396U) << run.output;
  EXPECT_LT(run.odometry_end.position, 0.05) << run.output;
  EXPECT_LT(run.odometry_end.heading, 2.0);
}

}  // namespace
}  // namespace sightline
