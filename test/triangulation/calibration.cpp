#include "sightline/triangulation/calibration.h"

#include <cmath>

#include <gmock/gmock.h>

#include "config_error.h"
#include "sightline/triangulation/calibration_writer.h"
#include "temporary_folder.h"

namespace sightline::triangulation {
namespace {

using test::errorOf;
using testing::HasSubstr;

Calibration smallCalibration() {
  SensorParameters parameters;
  parameters.serial = "a \"b\": #c";
  parameters.scan.beams = 5;
  parameters.origin.projected_vergence = 0.1 / 3.0;
  return {parameters, modelledTable(parameters, tableDepths(0.35, 2.85, 12))};
}

std::string yamlOf(const Calibration& calibration) {
  return toYaml(calibration, ParameterVector::Constant(1e-5));
}

Calibration readYaml(const std::string& text) {
  return Calibration::read(config::Node::parse(text, "c.yaml"));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Calibration, IsReadBackAsWritten) {
  const Calibration written = smallCalibration();
  const test::TemporaryFolder folder;
  const auto read = Calibration::readFile(folder.write("c.yaml", yamlOf(written)));
  EXPECT_EQ(read.parameters.serial, written.parameters.serial);
  EXPECT_EQ(read.parameters.scan.beams, 5);
  EXPECT_EQ(read.parameters.intrinsics.vergence, written.parameters.intrinsics.vergence);
  EXPECT_EQ(read.parameters.origin.projected_vergence, 0.1 / 3.0);
  EXPECT_EQ(read.parameters.noise_current, written.parameters.noise_current);
  EXPECT_EQ(read.table.depths(), written.table.depths());
  for (std::size_t beam = 0; beam < 5; ++beam) {
    const auto before = written.table.imagePositions(beam);
    const auto after = read.table.imagePositions(beam);
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_TRUE(before[i] == after[i] || (std::isnan(before[i]) && std::isnan(after[i])));
    }
  }
  EXPECT_THAT(yamlOf(written), HasSubstr("intrinsics.focal_length: 1e-05 # m\n"));
}

TEST(Calibration, RefusesParametersOutsideTheirPhysics) {
  const std::string good = yamlOf(smallCalibration());
  const auto fault = [&](const std::string& from, const std::string& to) {
    return errorOf([&] { readYaml(replaced(good, from, to)); }).key();
  };
  EXPECT_EQ(fault("focal_length: 0.05", "focal_length: 0"), "intrinsics.focal_length");
  EXPECT_EQ(fault("focal_length: 0.05", "focal_length: -0.05"), "intrinsics.focal_length");
  EXPECT_EQ(fault("  vergence: 0.11", "  vergence: 0.79 #"), "intrinsics.vergence");
  EXPECT_EQ(fault("range_min: 0.4", "range_min: 2.6"), "range_min");
  EXPECT_EQ(fault("\"a \\\"b\\\": #c\"", "\"\""), "sensor");
}

TEST(Calibration, RefusesTablesThatDoNotFit) {
  const std::string good = yamlOf(smallCalibration());
  const auto fault = [&](const std::string& from, const std::string& to) {
    return errorOf([&] { readYaml(replaced(good, from, to)); });
  };
  const auto beams = fault("beams: 5", "beams: 6");
  EXPECT_THAT(beams.what(), HasSubstr("table: is of 5 beams, the scan of 6"));
  EXPECT_GT(beams.line(), 0);
  EXPECT_EQ(fault("depths: [", "depths: [0.1, ").key(), "table.image_positions[0]");
  EXPECT_THAT(fault("table:", "tables:").what(), HasSubstr("unknown key"));
  const std::string cut = good.substr(0, good.find("image_positions"));
  EXPECT_THAT(errorOf([&] { readYaml(cut); }).what(), HasSubstr("image_positions"));
  EXPECT_THAT(errorOf([&] { readYaml(good.substr(0, good.find("noise_current"))); }).what(),
              HasSubstr("missing key 'noise_current'"));
}

TEST(Calibration, IsOfOneSensorAlone) {
  const Calibration calibration = smallCalibration();
  calibration.requireSensor("a \"b\": #c", "s.yaml");
  const auto error = errorOf([&] { calibration.requireSensor("SS-0002", "s.yaml"); });
  EXPECT_THAT(error.what(), HasSubstr("not of 'SS-0002'"));
  EXPECT_EQ(error.key(), "sensor");
}

TEST(Calibration, ModelledTableLeavesOutWhatIsBeyondTheDetector) {
  const SensorParameters sensor;
  const auto table = modelledTable(sensor, tableDepths(0.2, 2.85, 40));
  EXPECT_EQ(table.beams(), 256U);
  EXPECT_TRUE(std::isnan(table.imagePositions(0)[0]));
  for (const double p : table.imagePositions(128)) EXPECT_FALSE(std::abs(p) > 0.005);
}

TEST(Calibration, DepthsAreUniformInTheirInverse) {
  const auto depths = tableDepths(0.5, 2.0, 4);
  ASSERT_EQ(depths.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(1.0 / depths[i], 2.0 - 0.5 * static_cast<double>(i), 1e-12);
  }
}

// One image position for each depth and beam, as far as `seen` says.
CalibrationRecording recordingOf(const std::vector<double>& depths, std::size_t beams) {
  CalibrationRecording recording;
  for (const double depth : depths) {
    recording.placements.push_back({depth, {}, {}});
    for (std::size_t beam = 0; beam < beams; ++beam) {
      recording.placements.back().beams.push_back({beam, 1, 1e-3 / depth, 1e-8});
    }
  }
  return recording;
}

TEST(TableOf, IsFilledByPlainTargets) {
  ScanPattern scan;
  scan.beams = 3;
  auto recording = recordingOf({2.0, 0.5, 1.0}, 3);
  recording.placements[1].beams.pop_back();
  recording.placements.push_back({0.7, Stripes{0.0, 0.1}, {{0, 1, 9e-3, 1e-8}}});
  const auto table = tableOf(recording, scan);
  EXPECT_EQ(table.depths(), (std::vector<double>{0.5, 1.0, 2.0}));
  EXPECT_EQ(table.imagePositions(0), (std::vector<double>{2e-3, 1e-3, 0.5e-3}));
  EXPECT_TRUE(std::isnan(table.imagePositions(2)[0]));
}

TEST(TableOf, NamesWhatWasNotRecorded) {
  ScanPattern scan;
  scan.beams = 4;
  const auto fault = [&](const CalibrationRecording& recording) {
    return errorOf([&] { tableOf(recording, scan, "r.csv"); });
  };
  EXPECT_STREQ(fault(recordingOf({0.5, 1.0}, 3)).what(),
               "r.csv: image_positions[3]: fewer than two targets were seen");
  EXPECT_EQ(fault(recordingOf({0.5}, 4)).key(), "depths");
  EXPECT_EQ(fault({}).key(), "depths");
}

}  // namespace
}  // namespace sightline::triangulation
