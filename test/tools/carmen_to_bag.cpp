#include <filesystem>

#include <gmock/gmock.h>

#include "carmen_room.h"
#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using test::ProgramResult;
using test::runProgram;
using test::TemporaryFolder;
using testing::HasSubstr;

ProgramResult convert(const TemporaryFolder& folder, const std::string& log,
                      const std::string& options = "") {
  return runProgram("carmen_to_bag",
                    folder.write("a.clf", log) + " " + folder.path("a.bag") + " " + options);
}

TEST(CarmenToBag, CountsWhatItWrote) {
  const TemporaryFolder folder;
  const auto result = convert(folder, test::carmenRoomLog(5),
                              "--reverse-from-tv --odometry-delay 0.12 --laser-offset -0.04");
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.output, folder.path("a.bag") + ": 5 scans, 10 odometry poses\n");
  EXPECT_TRUE(std::filesystem::exists(folder.path("a.bag")));
}

TEST(CarmenToBag, KeepsWhatPrecedesTheCutOfALog) {
  const TemporaryFolder folder;
  const std::string log = test::carmenRoomLog(5);
  const auto result = convert(folder, log.substr(0, log.size() - 200));
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output, HasSubstr("a.clf:16: the log is cut off in the middle of a line"));
  EXPECT_THAT(result.output, HasSubstr("4 scans, 9 odometry poses\n"));
}

TEST(CarmenToBag, NamesLineAndKindOfWhatItCannotRead) {
  const TemporaryFolder folder;
  const std::string bad = "ODOM 1 2 x 0 0 0 12.5 h 0\n";
  const auto result = convert(folder, bad + test::carmenRoomLog(1));
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output, HasSubstr("a.clf:1: ODOM: theta: expected a number, found 'x'\n"));
  EXPECT_THAT(result.output, HasSubstr("1 lines that cannot be understood are left out\n"));
  EXPECT_THAT(result.output, HasSubstr("1 scans, 2 odometry poses\n"));
}

TEST(CarmenToBag, MakesNoBagOfALogWithoutScans) {
  const TemporaryFolder folder;
  const auto result = convert(folder, "some text\n");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("no scans in the log: neither FLASER nor ROBOTLASER1"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("a.bag")));
}

TEST(CarmenToBag, NamesTheFileThatIsMissing) {
  const auto result = runProgram("carmen_to_bag", "/none/a.clf /none/a.bag");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("/none/a.clf: No such file or directory"));
}

TEST(CarmenToBag, ExplainsItself) {
  EXPECT_EQ(runProgram("carmen_to_bag", "--help").status, 0);
  for (const char* arguments :
       {"", "a.clf", "a.clf a.bag --odometry-delay", "a.clf a.bag --odometry-delay x",
        "a.clf a.bag b.bag", "a.clf a.bag --unknown", "--unknown a.clf a.bag"}) {
    const auto result = runProgram("carmen_to_bag", arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_THAT(result.output, HasSubstr("usage: carmen_to_bag")) << arguments;
  }
}

}  // namespace
}  // namespace sightline
