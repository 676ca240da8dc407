#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using testing::HasSubstr;

// On its standard input is what `script` prints. Once it has said something, it is told to end.
test::ProgramResult emulate(const std::string& arguments, const std::string& script = ":") {
  const test::TemporaryFolder folder;
  const std::string said = folder.path("said");
  return test::runCommand(
      "{ { " + script + "; } | " SIGHTLINE_PROGRAMS "/sensor_emulator " + arguments + " > " + said +
      " 2>&1 & for i in $(seq 6000); do test -s " + said + " && break; sleep 0.01; done; " +
      "kill $! 2> /dev/null; wait $!; status=$?; cat " + said + "; exit $status; }");
}

const std::string kWorld = "--world " SIGHTLINE_SOURCE_DIR "/config/worlds/living_room.yaml ";

TEST(SensorEmulator, TakesWordsAndLeavesNoPortBehind) {
  const test::TemporaryFolder folder;
  const auto result = emulate(folder.path("port") + " " + kWorld + "--pose -1.5 1.0 2.5",
                              "printf 'jitter 0.001\\nstall 0.1\\nexplode 1\\n'");
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.output, "standard input: explode: no such fault\n");
  EXPECT_EQ(test::runCommand("ls -A " + folder.path("")).output, "");
}

TEST(SensorEmulator, SaysWhyThePortCannotComeBack) {
  const test::TemporaryFolder folder;
  const std::string port = folder.path("port");
  const std::string file = folder.write("file", "");
  const auto result =
      emulate(port + " " + kWorld, "until test -L " + port + "; do sleep 0.01; done; mv " + file +
                                       " " + port + "; echo disconnect 0.01");
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.output, port + ": exists, and is no link to a terminal\n");
}

TEST(SensorEmulator, BadOptionsEndIt) {
  const test::TemporaryFolder folder;
  const auto at_start = emulate(folder.path("port") + " " + kWorld + "--faults 'drift fast'");
  EXPECT_EQ(at_start.status, 1);
  EXPECT_EQ(at_start.output, "--faults: drift: needs one number\n");
  for (const std::string seed : {"-1", "0.5", "1e30"}) {
    const auto result = emulate(folder.path("port") + " " + kWorld + "--seed " + seed);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.output, HasSubstr("--seed: needs a whole number, not '" + seed + "'"));
  }
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
