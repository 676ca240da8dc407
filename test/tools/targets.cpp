// From a folder of the multi-robot data to targets and their score.
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "sightline/targets/simulated_team.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using test::runProgram;
using test::TemporaryFolder;
using testing::HasSubstr;

// A simulated team whose bearings are logged as those of the data are: 120 s, empty looks left out.
void writeFolder(const TemporaryFolder& folder) {
  targets::TeamConfig config;
  config.size = 6.0;
  config.targets = 4;
  config.model.field_of_view = {-0.6, 0.6};
  config.model.bearing.sigma = 0.008;
  config.model.detection = {0.4, 1.0, 0.01, 0.0, 8.0, {}};
  config.model.clutter = {0.02, 1.0, 0.0};
  config.period = 0.24;
  targets::SimulatedTeam team(config, 3);
  std::string barcodes, landmarks, truth[3], looks[3];
  for (std::size_t i = 0; i < 4; ++i) {
    barcodes += fmt::format("{} {}\n", i + 6, i + 60);
    landmarks += fmt::format("{} {} {} 0 0\n", i + 6, team.targets()[i].x(), team.targets()[i].y());
  }
  while (team.time() < 120'000'000'000) {
    const double now = 1000.0 + 1e-9 * static_cast<double>(team.time());
    for (const auto& set : team.step()) {
      const std::size_t robot = set.set.robot;
      const auto& pose = set.T_map_sensor;
      truth[robot] += fmt::format("{:.3f} {} {} {}\n", now, pose.x(), pose.y(), pose.theta());
      for (std::size_t m = 0; m < set.set.bearings.size(); ++m) {
        const std::size_t barcode = set.origins[m] ? 60 + *set.origins[m] : 99;
        looks[robot] += fmt::format("{:.3f} {} 2.0 {}\n", now, barcode, set.set.bearings[m]);
      }
    }
  }
  folder.write("Barcodes.dat", barcodes);
  folder.write("Landmark_Groundtruth.dat", landmarks);
  for (int robot = 0; robot < 3; ++robot) {
    const auto name = [&](const char* kind) {
      return fmt::format("Robot{}_{}.dat", robot + 1, kind);
    };
    folder.write(name("Groundtruth"), truth[robot]);
    folder.write(name("Measurement"), looks[robot]);
    folder.write(name("Odometry"), "1000.0 0.1 0.0\n");
  }
}

TEST(Targets, FromDataToScore) {
  const TemporaryFolder folder;
  writeFolder(folder);
  const auto bag = folder.path("set.bag");
  const auto converted = runProgram("mrclam_to_bag", folder.path("") + " " + bag);
  ASSERT_EQ(converted.status, 0) << converted.output;
  EXPECT_THAT(converted.output, HasSubstr("3 robots, "));
  EXPECT_THAT(converted.output, HasSubstr("empty ones put back"));
  const auto settings = folder.write("team.yaml", "targets: {robots: [robot1, robot2, robot3]}\n");
  const auto models = folder.path("models");
  const auto found = runProgram(
      "characterize_bearing_sensor",
      fmt::format("--config {} --targets {}.truth.csv --out {} {}", settings, bag, models, bag));
  ASSERT_EQ(found.status, 0) << found.output;
  EXPECT_THAT(found.output, HasSubstr("theta_c: undetermined by these data"));
  for (const char* file : {"detection.png", "sigma.png", "clutter.png", "cardinality.png"}) {
    EXPECT_GT(std::filesystem::file_size(models + "/" + file), 1000U) << file;
  }
  const auto with_models = folder.write(
      "tracked.yaml",
      "targets: {robots: [robot1, robot2, robot3], models: models/sensor_models.yaml}\n");
  const auto tracked = runProgram("offline", fmt::format("--config {} --nodes targets --out {} {}",
                                                         with_models, folder.path("out"), bag));
  ASSERT_EQ(tracked.status, 0) << tracked.output;
  EXPECT_THAT(tracked.output, HasSubstr("looks used"));
  const auto scored = runProgram(
      "evaluate_targets", folder.path("out/targets.csv") + " " + bag + ".truth.csv --from 90");
  EXPECT_EQ(scored.status, 0);
  const double ospa = std::stod(scored.output.substr(scored.output.find("ospa_mean ") + 10));
  EXPECT_LT(ospa, 0.5) << scored.output;
}

TEST(Targets, PartOfASetIsABagOfItsOwn) {
  const TemporaryFolder folder;
  writeFolder(folder);
  const auto looksOf = [&](const std::string& options) {
    const auto run =
        runProgram("mrclam_to_bag", folder.path("") + " " + folder.path("part.bag ") + options);
    EXPECT_EQ(run.status, 0) << run.output;
    return std::stoi(run.output.substr(run.output.find("robots, ") + 8));
  };
  const int all = looksOf("");
  const int first = looksOf("--to 60");
  EXPECT_NEAR(first, 0.5 * all, 0.05 * all);
  EXPECT_NEAR(first + looksOf("--from 60"), all, 3.0);
  const auto none =
      runProgram("mrclam_to_bag", folder.path("") + " " + folder.path("none.bag") + " --from 9999");
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(none.output, HasSubstr("the set has nothing in that time"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("none.bag")));
}

TEST(Targets, SayWhatIsMissing) {
  const TemporaryFolder folder;
  writeFolder(folder);
  const auto bag = folder.path("set.bag");
  runProgram("mrclam_to_bag", folder.path("") + " " + bag);
  const auto run = [&](const std::string& settings, const std::string& nodes) {
    const auto path = folder.write("team.yaml", settings);
    return runProgram("offline", fmt::format("--config {} --nodes {} --out {} {}", path, nodes,
                                             folder.path("out"), bag));
  };
  EXPECT_THAT(run("targets: {robots: [robot9]}\n", "targets").output,
              HasSubstr("no bearings on /robot9/bearings"));
  EXPECT_THAT(run("lines: {}\n", "targets").output, HasSubstr("targets: missing"));
  EXPECT_EQ(run("targets: {robots: [robot1]}\n", "lines,targets").status, 2);
  EXPECT_THAT(run("targets: {robots: [robot1], models: none.yaml}\n", "targets").output,
              HasSubstr("none.yaml"));
  EXPECT_EQ(runProgram("mrclam_to_bag", "nowhere " + bag).status, 1);
  const auto blind = folder.write("blind.yaml", "targets: {robots: [robot1], pose_topic: none}\n");
  EXPECT_THAT(runProgram("characterize_bearing_sensor",
                         fmt::format("--config {} --targets {}.truth.csv --out {} {}", blind, bag,
                                     folder.path("models"), bag))
                  .output,
              HasSubstr("no look has a pose"));
  EXPECT_THAT(runProgram("characterize_bearing_sensor",
                         fmt::format("--config {} --targets {}.truth.csv --out {} --scan /scan {}",
                                     folder.write("team.yaml", "targets: {robots: [robot1]}\n"),
                                     bag, folder.path("models"), bag))
                  .output,
              HasSubstr("no scan with intensities"));
}

}  // namespace
}  // namespace sightline
