// Recordings of other people's robots through `offline`, row by row.
#include "robot_edits.h"

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>

namespace sightline {
namespace {

using geometry::Pose2;
using test::RobotInput;
using test::RobotRun;
using test::runOffline;
using testing::HasSubstr;
using testing::Not;

// Rooms and odometry as close as on a recording that is as it should be, or as the row asks for.
RobotRun expectGood(const RobotInput& input, double position = 0.05, double heading = 2.0) {
  RobotRun run = runOffline(input);
  EXPECT_EQ(run.status, 0) << input.name << "\n" << run.output;
  EXPECT_FALSE(run.has_nan) << input.name;
  EXPECT_GT(run.room_poses, 150U) << input.name << "\n" << run.output;
  EXPECT_GT(run.tracking, 140U) << input.name << "\n" << run.output;
  EXPECT_LT(run.rooms_worst.position, position) << input.name << "\n" << run.output;
  EXPECT_LT(run.rooms_worst.heading, heading) << input.name;
  EXPECT_LT(run.rooms_end.position, position) << input.name;
  EXPECT_GT(run.odometry_poses, 150U) << input.name << "\n" << run.output;
  EXPECT_LT(run.odometry_end.position, position) << input.name << "\n" << run.output;
  EXPECT_LT(run.odometry_end.heading, heading) << input.name;
  return run;
}

TEST(OtherRobots, RecordingAsItShouldBe) {
  const RobotRun run = expectGood(test::asItShouldBe(), 0.02, 0.5);
  EXPECT_EQ(run.room_poses, 198U);
}

TEST(OtherRobots, Row1AbsurdOdometryIsRefusedByNameAndCounted) {
  for (const double x : {1e256, 1e6, 1e40, 1e155, std::nan("")}) {
    for (const RobotInput& input :
         {test::absurdOdometry(x), test::onTopic(test::absurdOdometry(x))}) {
      const RobotRun run = expectGood(input);
      EXPECT_THAT(run.output, HasSubstr("30 messages dropped: ")) << x;
      EXPECT_THAT(run.output, HasSubstr("a position ")) << x;
    }
  }
  const double subnormal = std::numeric_limits<double>::denorm_min();
  const RobotRun run = expectGood(test::absurdOdometry(0.0, subnormal));
  EXPECT_THAT(run.output, HasSubstr("an orientation of norm"));
}

TEST(OtherRobots, Row2BreaksOfTheOdometryAreBridged) {
  for (const RobotInput& input :
       {test::resetOdometry(10.0), test::onTopic(test::resetOdometry(10.0)),
        test::leapingOdometry(7.03, Pose2(1.0, -2.0, 0.0)),
        test::leapingOdometry(12.0, Pose2(0.0, 0.0, 2.0))}) {
    const RobotRun run = expectGood(input);
    EXPECT_GE(run.not_tracking, 1U) << "nothing flagged: " << input.name;
    EXPECT_THAT(run.output, HasSubstr("the odometry broke 1 times"));
  }
}

TEST(OtherRobots, Row3MissesAreNoSurfaces) {
  expectGood(test::missesAs(2.2, std::numeric_limits<double>::infinity()), 0.03, 1.0);
  for (const double reported : {2.2, 2.15, 2.1999}) {
    expectGood(test::missesAs(2.2, reported), 0.03, 1.0);
  }
}

TEST(OtherRobots, Row4StrayStampsAreDroppedByReason) {
  const auto isDropped = [](const RobotInput& input, const std::string& reason) {
    const RobotRun run = expectGood(input);
    EXPECT_THAT(run.output, HasSubstr("20 of 198 scans dropped: " + reason)) << input.name;
  };
  isDropped(test::strayStamps("end_of_time", [](double) { return 4294967295.0; }),
            "a stamp of 4294967295 s, out of range");
  isDropped(test::strayStamps("zero", [](double) { return 0.0; }), "a stamp of zero");
  isDropped(test::strayStamps("past", [](double stamp) { return stamp - 402.0; }),
            "a stamp far behind the ones before it");
  isDropped(test::strayStamps("future", [](double stamp) { return stamp + 3600.0; }),
            "a stamp far ahead of the ones before it");
}

TEST(OtherRobots, Row7SteppingStampsStartAgain) {
  const RobotRun run = expectGood(test::steppingStamps(10.0, -100.0));
  EXPECT_THAT(run.output, HasSubstr("the clock was set 1 times"));
  expectGood(test::steppingStamps(10.0, 100.0));
}

TEST(OtherRobots, Row8OneLeadingSlashIsStripped) {
  for (const bool backward : {false, true}) {
    RobotInput input = test::withSlashes(backward);
    expectGood(input);
    input.settings = "frames: {odom: /odom, base: /base_link, map: /map}\n";
    const RobotRun run = expectGood(input);
    EXPECT_THAT(run.output, Not(HasSubstr("Invalid argument")));
  }
}

TEST(OtherRobots, Row9MountingThatIsNotLevelIsRefusedByName) {
  RobotInput input = test::asItShouldBe();
  input.bag.mount = [](geometry_msgs::TransformStamped& mount) {
    auto& q = mount.transform.rotation;
    q.x = q.z = -0.5;
    q.y = q.w = 0.5;
  };
  RobotRun run = runOffline(input);
  EXPECT_EQ(run.status, 3) << run.output;
  EXPECT_EQ(run.room_poses, 0U);
  EXPECT_THAT(run.output, HasSubstr("198 scans: its plane is not level: laser is tilted by 90 "
                                    "degrees in base_link; what to do: correct the mounting"));
  input.bag.mount = nullptr;
  input.bag.mounting.roll = geometry::kPi;
  expectGood(input);
}

TEST(OtherRobots, Row10ScannerAtRestStaysThere) {
  RobotInput input = test::asItShouldBe();
  input.bag.moves = false;
  input.bag.seconds = 60.0;
  input.bag.beams = 512;
  input.options = "--no-wheels --nodes odometry";
  for (const std::size_t returns : {512U, 175U}) {
    input.bag.scan = [=](sensor_msgs::LaserScan& scan, double) {
      std::fill(scan.ranges.begin() + static_cast<std::ptrdiff_t>(returns), scan.ranges.end(),
                std::numeric_limits<float>::infinity());
    };
    for (const std::string carrier : {"wheeled", "body_worn"}) {
      input.settings = "carrier: " SIGHTLINE_SOURCE_DIR "/config/carriers/" + carrier + ".yaml\n";
      const RobotRun run = runOffline(input);
      EXPECT_EQ(run.status, 0) << run.output;
      EXPECT_LT(run.odometry_end.position, 0.01) << carrier << " " << returns;
      EXPECT_LT(run.odometry_end.heading, 0.5) << carrier << " " << returns;
    }
  }
}

TEST(OtherRobots, Row11PartialSweepsAreGatheredToATurn) {
  const RobotRun run = expectGood(test::partialSweeps(12));
  EXPECT_LT(run.room_poses, 205U);
  expectGood(test::partialSweeps(3));
}

TEST(OtherRobots, Row15TimeOffsetMendsStampsAtTheEndOfTheSweep) {
  RobotInput input = test::asItShouldBe();
  input.bag.revolution = 0.097;
  input.bag.scan = [](sensor_msgs::LaserScan& scan, double) {
    scan.header.stamp += ros::Duration(0.097);
  };
  input.settings = "time_offset: -0.097\n";
  expectGood(input, 0.02, 0.5);
}

TEST(OtherRobots, Row16SweepThatCannotBeTrueIsOfUnknownDuration) {
  RobotInput input = test::asItShouldBe();
  input.bag.scan = [](sensor_msgs::LaserScan& scan, double) {
    scan.time_increment = 153333.0F;
    scan.scan_time = 1.1e8F;
  };
  const RobotRun run = expectGood(input);
  EXPECT_THAT(run.output, HasSubstr("/scan: time_increment 153333 would be a sweep of"));
}

TEST(OtherRobots, Row17IntensitiesOfAnotherLengthAreIgnored) {
  for (const std::size_t length : {359U, 1U, 720U}) {
    RobotInput input = test::asItShouldBe();
    input.bag.scan = [=](sensor_msgs::LaserScan& scan, double) {
      scan.intensities.assign(length, 100.0F);
    };
    EXPECT_THAT(expectGood(input).output, HasSubstr(" intensities for 360 ranges: taken for none"));
    input.settings = "noise: {kind: intensity, intensity_sigma: 1.0}\n";
    const RobotRun run = runOffline(input);
    EXPECT_EQ(run.status, 3);
    EXPECT_THAT(run.output, HasSubstr("no intensities, by which the noise is to be known"));
  }
}

TEST(OtherRobots, Row18TopicsOfAllKinds) {
  RobotInput input = test::asItShouldBe();
  input.name = "without_slash";
  input.bag.scan_topic = "scan";
  input.bag.tf_topic = "tf";
  input.bag.static_topic = "tf_static";
  expectGood(input);
  expectGood(test::onTopic(test::asItShouldBe()));
  expectGood(test::multiEcho());
  input = test::asItShouldBe();
  input.name = "split";
  input.splits = {5.0, 10.0};
  expectGood(input);
}

TEST(OtherRobots, Row18WithoutTheFirstBagTheReasonIsNamed) {
  const RobotInput input = test::asItShouldBe();
  const test::TemporaryFolder folder;
  input.bag.write(folder.path("second.bag"), 5.0);
  const RobotRun run = runOffline(input, folder, " " + folder.path("second.bag"));
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.output, HasSubstr("no transform from base_link to laser at its time; what to do: "
                                    "record /tf_static, give the first of several split bags"));
}

TEST(OtherRobots, Row19CutBagsAreReadOrTheLineIsNamed) {
  const RobotInput input = test::asItShouldBe();
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.bag");
  input.bag.write(path);
  const auto size = std::filesystem::file_size(path);
  for (const double share : {0.5, 0.99}) {
    std::filesystem::resize_file(path,
                                 static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    const RobotRun run = runOffline(input, folder, " " + path);
    EXPECT_NE(run.status, 0);
    EXPECT_THAT(run.output, HasSubstr("rosbag reindex '" + path + "'"));
  }
}

// What is behind the damage is lost, what is before it is not.
TEST(OtherRobots, Row19DamagedBagIsReadAsFarAsItGoes) {
  const RobotInput input = test::asItShouldBe();
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.bag");
  input.bag.write(path);
  const auto middle = static_cast<std::streamoff>(std::filesystem::file_size(path) / 2);
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(middle);
  file << std::string(5000, '\0');
  file.close();
  const RobotRun run = runOffline(input, folder, " " + path);
  EXPECT_FALSE(run.isCrash());
  EXPECT_NE(run.status, 0) << run.output;
}

TEST(OtherRobots, NoReasonIsLeftOut) {
  RobotInput input = test::asItShouldBe();
  input.settings = "frames: {base: robot}\n";
  const RobotRun run = runOffline(input);
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.output, HasSubstr("rooms: used only 0 of 198 scans, as"));
  EXPECT_THAT(run.output, HasSubstr("198 scans: no transform from robot to laser"));
}

}  // namespace
}  // namespace sightline
