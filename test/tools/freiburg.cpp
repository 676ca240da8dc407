// The way of the log fr079 through all three programs.
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>

#include "sightline/logs/trajectory_error.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using test::runProgram;
using testing::HasSubstr;

TEST(Freiburg, IsTrackedThroughItsRooms) {
  const char* data = std::getenv("SIGHTLINE_DATA");
  const std::filesystem::path folder = data ? data : "";
  if (!data || !std::filesystem::exists(folder / "fr079.clf.gz")) {
    GTEST_SKIP() << "SIGHTLINE_DATA holds no fr079.clf.gz";
  }
  const test::TemporaryFolder temporary;
  const auto conversion = runProgram(
      "carmen_to_bag", (folder / "fr079.clf.gz").string() + " " + temporary.path("in.bag") +
                           " --reverse-from-tv --odometry-delay 0.12");
  EXPECT_EQ(conversion.output, temporary.path("in.bag") + ": 4934 scans, 8951 odometry poses\n");
  const auto tracking =
      runProgram("offline", "--config " SIGHTLINE_SOURCE_DIR "/config/offline/fr079.yaml " +
                                temporary.path("in.bag") + " --out " + temporary.path("out") +
                                " --nodes rooms");
  // The first scan is older than the odometry.
  EXPECT_THAT(tracking.output, HasSubstr("rooms: 4933 of 4934 scans have a pose"));
  const auto evaluation = runProgram(
      "evaluate_trajectory", temporary.path("out/rooms.tum") + " --relations " +
                                 (folder / "fr079.relations").string() + " --offset 0.04 0 0");
  EXPECT_THAT(evaluation.output, HasSubstr("relations.used 1685 of 1685\n"));
  const auto errors = logs::compareWithRelations(
      logs::readTrajectory(temporary.path("out/rooms.tum")),
      logs::readRelations((folder / "fr079.relations").string()), {0.04, 0.0, 0.0});
  EXPECT_EQ(evaluation.output, logs::figures(errors));
  ASSERT_TRUE(errors.short_term);
  EXPECT_LT(errors.short_term->translation.mean, 0.06);
  EXPECT_LT(errors.short_term->rotation.mean, 0.8);
  EXPECT_LT(errors.all->translation.mean, 0.20);
  EXPECT_LT(errors.all->rotation.mean, 2.0);
}

}  // namespace
}  // namespace sightline
