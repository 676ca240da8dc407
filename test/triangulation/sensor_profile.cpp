#include "sightline/triangulation/sensor_profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_error.h"
#include "sightline/triangulation/calibration_writer.h"
#include "temporary_folder.h"

namespace sightline::triangulation {
namespace {

TEST(SensorProfile, TakesNoCalibrationOfAnotherScan) {
  const test::TemporaryFolder folder;
  SensorProfile profile;
  const auto calibration = profile.calibrated();
  profile.calibration =
      folder.write("calibration.yaml", toYaml(calibration, ParameterVector::Zero()));
  EXPECT_NO_THROW(profile.calibrated());
  profile.sensor.scan.field_of_view = 0.6;
  EXPECT_EQ(test::errorOf([&] { profile.calibrated(); }).key(), "scan.field_of_view");
  profile = {};
  profile.sensor.serial = "SS-0002";
  profile.calibration = folder.path("calibration.yaml");
  EXPECT_EQ(test::errorOf([&] { profile.calibrated(); }).key(), "sensor");
}

TEST(SensorProfile, ReadsTheShippedFileAndLeavesTheSimulatedPartAlone) {
  const std::string path = SIGHTLINE_SOURCE_DIR "/config/sensors/synchronised_scan.yaml";
  const auto shipped = SensorProfile::readFile(path);
  EXPECT_NEAR(shipped.sensor.intrinsics.vergence, SensorProfile{}.sensor.intrinsics.vergence,
              1e-15);
  const auto table = shipped.calibrated().table;
  EXPECT_EQ(table.depths(), SensorProfile{}.calibrated().table.depths());
}

TEST(SensorProfile, NamesWhatIsWrong) {
  const test::TemporaryFolder folder;
  const auto faultOf = [&](const std::string& text) -> std::string {
    const std::string path = folder.write("sensor.yaml", text);
    return test::errorOf([&] { SensorProfile::readFile(path).calibrated(); }).what();
  };
  EXPECT_THAT(faultOf("scan: {beems: 3}"), testing::HasSubstr("sensor.yaml:1: scan.beems"));
  EXPECT_THAT(faultOf("head: {uper: 3}"), testing::HasSubstr("sensor.yaml:1: head.uper"));
  EXPECT_THAT(faultOf("head: {lower: 1.0, upper: 0.5}"), testing::HasSubstr("is not below upper"));
  EXPECT_THAT(faultOf("calibration: nowhere.yaml"), testing::HasSubstr("nowhere.yaml"));
  EXPECT_THAT(faultOf("modelled_depths: {nearest: 3.0}"),
              testing::HasSubstr("modelled_depths.nearest: is not below farthest"));
}

}  // namespace
}  // namespace sightline::triangulation
