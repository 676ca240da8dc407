// The check of a device, with an emulated one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using testing::HasSubstr;
using testing::Not;

// The device runs beside the check and ends after it.
test::ProgramResult checkDevice(const std::string& device, const std::string& arguments) {
  const test::TemporaryFolder folder;
  const std::string port = folder.path("port");
  return test::runCommand(
      "{ " SIGHTLINE_PROGRAMS "/sensor_emulator " + port +
      " --world " SIGHTLINE_SOURCE_DIR "/config/worlds/living_room.yaml --pose -1.5 1.0 2.5 " +
      device + " > /dev/null 2>&1 & " SIGHTLINE_PROGRAMS "/check_device " + port + " --seconds 2 " +
      arguments + "; status=$?; kill $!; wait $!; exit $status; }");
}

TEST(CheckDevice, GoodDeviceIsRight) {
  const auto result = checkDevice("", "--head");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("right  identity  SYNC-SCAN SS-0001, firmware 1.0"));
  EXPECT_THAT(result.output, HasSubstr("right  head      told to turn by 0.150 rad"));
  EXPECT_THAT(result.output, Not(HasSubstr("WRONG")));
}

TEST(CheckDevice, BrokenBytesAreWrong) {
  const auto result = checkDevice("--faults 'corrupted 3e-4'", "");
  EXPECT_EQ(result.status, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("WRONG  frames"));
}

TEST(CheckDevice, WithoutADeviceItSaysWhy) {
  const auto result = test::runCommand(SIGHTLINE_PROGRAMS "/check_device /nowhere/port");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("WRONG  device    no such port: /nowhere/port"));
}

}  // namespace
}  // namespace sightline
