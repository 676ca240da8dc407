#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>

#include "sightline/simulation/active_sensor_profile.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using test::runProgram;
using test::TemporaryFolder;
using testing::HasSubstr;

const std::string kSensor = SIGHTLINE_SOURCE_DIR "/config/sensors/synchronised_scan.yaml";

// Printed value of a parameter, in mm or degrees.
double valueOf(const std::string& output, const std::string& key) {
  const auto begin = output.find(key);
  if (begin == std::string::npos) return std::nan("");
  return std::stod(output.substr(begin + key.size()));
}

TEST(CalibrateSensor, MakesACalibrationThatTheSensorTakes) {
  const TemporaryFolder folder;
  const auto simulated = runProgram(
      "calibrate_sensor", "--sensor " + kSensor + " --simulate 3 --out " + folder.path("a"));
  EXPECT_EQ(simulated.status, 0) << simulated.output;
  EXPECT_NEAR(valueOf(simulated.output, "intrinsics.baseline"), 84.9, 0.04);
  EXPECT_NEAR(valueOf(simulated.output, "origin.projected_vergence"), 1.5, 0.0025);
  EXPECT_TRUE(std::filesystem::exists(folder.path("a/residuals.png")));

  auto profile = simulation::ActiveSensorProfile::readFile(kSensor);
  profile.calibration = folder.path("a/calibration.yaml");
  const auto calibration = profile.calibrated();
  EXPECT_EQ(calibration.table.beams(), 256U);
  EXPECT_NEAR(calibration.parameters.intrinsics.focal_length, 0.050, 2e-5);

  const auto recorded =
      runProgram("calibrate_sensor", folder.path("a/recording.csv") + " --sensor " + kSensor +
                                         " --out " + folder.path("b"));
  EXPECT_EQ(recorded.output, simulated.output);
  EXPECT_FALSE(std::filesystem::exists(folder.path("b/recording.csv")));
}

TEST(CalibrateSensor, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string sensor = " --sensor " + kSensor + " --out " + folder.path("c");
  for (const std::string& arguments : {std::string("--simulate 1"), sensor, "--simulate x" + sensor,
                                       "--simulate -1" + sensor, "a.csv --simulate 1" + sensor}) {
    const auto result = runProgram("calibrate_sensor", arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_THAT(result.output, HasSubstr("usage: calibrate_sensor")) << arguments;
  }
  const std::string missing =
      folder.write("m.csv", "target,depth_m,beam,readings,image_position_m\nplain,1,0,1,0\n");
  const auto column = runProgram("calibrate_sensor", missing + sensor);
  EXPECT_EQ(column.status, 1);
  EXPECT_THAT(column.output, HasSubstr("m.csv:1: current_A: missing column"));
  const std::string poor = folder.write(
      "p.csv", "target,depth_m,beam,readings,image_position_m,current_A\nplain,1,0,1,0,2e-8\n");
  const auto open = runProgram("calibrate_sensor", poor + sensor);
  EXPECT_EQ(open.status, 1);
  EXPECT_THAT(open.output, HasSubstr("intrinsics.vergence"));
  EXPECT_THAT(open.output, HasSubstr("not determined by this recording"));
}

TEST(EstimateNoiseCurrent, OfTable2) {
  const std::string table = SIGHTLINE_SOURCE_DIR "/config/calibration/table2.csv";
  const auto result = runProgram("estimate_noise_current", table);
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("noise_current 3.622e-11 A"));
  EXPECT_THAT(result.output, HasSubstr("product 181.1 um nA"));
  EXPECT_THAT(result.output, HasSubstr("free slope -1.019"));
  EXPECT_THAT(result.output, HasSubstr("189.8 um nA"));
  const auto twice = runProgram("estimate_noise_current", table + " --detector-length 0.02");
  EXPECT_THAT(twice.output, HasSubstr("noise_current 1.811e-11 A"));
}

TEST(EstimateNoiseCurrent, SaysWhatIsWrong) {
  const std::string table = SIGHTLINE_SOURCE_DIR "/config/calibration/table2.csv";
  for (const std::string& arguments : {std::string(), table + " --detector-length 0"}) {
    const auto result = runProgram("estimate_noise_current", arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_THAT(result.output, HasSubstr("usage: estimate_noise_current")) << arguments;
  }
  const auto missing = runProgram("estimate_noise_current", "/none.csv");
  EXPECT_EQ(missing.status, 1);
  EXPECT_THAT(missing.output, HasSubstr("/none.csv: no such file"));
}

}  // namespace
}  // namespace sightline
