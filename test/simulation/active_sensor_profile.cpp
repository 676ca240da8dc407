#include "sightline/simulation/active_sensor_profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_error.h"
#include "temporary_folder.h"

namespace sightline::simulation {
namespace {

TEST(ActiveSensorProfile, ShippedFileIsThePaperSensor) {
  const auto shipped =
      ActiveSensorProfile::readFile(SIGHTLINE_SOURCE_DIR "/config/sensors/synchronised_scan.yaml");
  const ActiveSensorProfile built_in;
  EXPECT_NEAR(shipped.sensor.intrinsics.vergence, built_in.sensor.intrinsics.vergence, 1e-15);
  EXPECT_EQ(shipped.optics.lens_diameter, built_in.optics.lens_diameter);
  EXPECT_NEAR(shipped.sensor.scan.scanPeriod(), 1.0 / 9.8, 0.001);
}

TEST(ActiveSensorProfile, TakesTheLimitsOfARobotDescription) {
  ActiveSensorProfile profile;
  driver::HeadJoint joint;
  joint.limits.upper = 1.0;
  joint.limits.max_rate = 2.0;
  joint.scan_origin = profile.sensor.origin.position();
  profile.takeHead(joint, "robot.urdf");
  EXPECT_EQ(profile.head.upper, 1.0);
  EXPECT_EQ(profile.head.max_rate, 2.0);
  joint.scan_origin.x() += 0.01;
  EXPECT_EQ(test::errorOf([&] { profile.takeHead(joint, "robot.urdf"); }).source(), "robot.urdf");
}

TEST(ActiveSensorProfile, NamesWhatIsWrong) {
  const test::TemporaryFolder folder;
  const auto faultOf = [&](const std::string& text) -> std::string {
    const std::string path = folder.write("sensor.yaml", text);
    return test::errorOf([&] { ActiveSensorProfile::readFile(path).calibrated(); }).what();
  };
  EXPECT_THAT(faultOf("optics: {rays: 0}"), testing::HasSubstr("sensor.yaml:1: optics.rays"));
  EXPECT_THAT(faultOf("head: {lower: 1.0, upper: 0.5}"), testing::HasSubstr("is not below upper"));
  EXPECT_THAT(faultOf("scan: {range_min: 3.0}"), testing::HasSubstr("is not below range_max"));
  EXPECT_THAT(faultOf("sensor: \"\""), testing::HasSubstr("serial number"));
  EXPECT_THAT(faultOf("calibration: nowhere.yaml"), testing::HasSubstr("nowhere.yaml"));
  EXPECT_THAT(faultOf("scan: {field_of_view: 2.0}\norigin: {projected_vergence: 0.5}"),
              testing::HasSubstr("turns the outermost beam"));
  EXPECT_THAT(faultOf("scan: {min_current: 1e-12}"), testing::HasSubstr("the noise current"));
  EXPECT_THAT(faultOf("rig: {nearest: 0.01}"), testing::HasSubstr("ahead of the scan's origin"));
  EXPECT_THAT(faultOf("modelled_depths: {nearest: 0.01}"),
              testing::HasSubstr("ahead of the scan's origin"));
  EXPECT_THAT(faultOf("jitter: 1.0"), testing::HasSubstr("sensor.yaml:1: jitter: 1 is outside"));
  EXPECT_THAT(faultOf("lens: 3"), testing::HasSubstr("lens"));
}

}  // namespace
}  // namespace sightline::simulation
