#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using testing::HasSubstr;

// For half a second, with words on its standard input; then it is told to end.
test::ProgramResult emulate(const std::string& arguments, const std::string& words = "") {
  return test::runCommand("{ printf '" + words +
                          "'; sleep 0.5; } | timeout --preserve-status 0.5 " +
                          std::string(SIGHTLINE_PROGRAMS) + "/sensor_emulator " + arguments);
}

const std::string kWorld = "--world " SIGHTLINE_SOURCE_DIR "/config/worlds/living_room.yaml ";

TEST(SensorEmulator, LeavesNoPortBehind) {
  const test::TemporaryFolder folder;
  const auto result = emulate(folder.path("port") + " " + kWorld + "--pose -1.5 1.0 2.5",
                              "jitter 0.001\\nstall 0.1\\n");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(test::runCommand("ls -A " + folder.path("")).output, "");
}

TEST(SensorEmulator, UnknownFaultsAreNamed) {
  const test::TemporaryFolder folder;
  const auto result = emulate(folder.path("port") + " " + kWorld, "explode 1\\n");
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.output, "standard input: explode: no such fault\n");
  const auto at_start = emulate(folder.path("port") + " " + kWorld + "--faults 'drift fast'");
  EXPECT_EQ(at_start.status, 1);
  EXPECT_EQ(at_start.output, "--faults: drift: needs one number\n");
}

TEST(SensorEmulator, BadFilesEndIt) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(emulate(folder.path("port") + " --world /nowhere.yaml").output,
              HasSubstr("/nowhere.yaml: no such file"));
  EXPECT_THAT(emulate("/nowhere/port " + kWorld).output, HasSubstr("/nowhere/port: no link"));
  EXPECT_THAT(emulate(folder.path("")).output, HasSubstr("--world"));
}

}  // namespace
}  // namespace sightline
