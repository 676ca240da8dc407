#include <gmock/gmock.h>

#include "temporary_folder.h"
#include "tools/program.h"

namespace sightline {
namespace {

using test::runProgram;
using test::TemporaryFolder;
using testing::HasSubstr;

TEST(EvaluateTrajectory, ComparesWithRelations) {
  const TemporaryFolder folder;
  const std::string trajectory = folder.write("a.tum", "1 0 0 0\n2 1 0 1.5707963267948966\n");
  const std::string relations = folder.write("a.relations", "1 2 1.04 0.04 0 0 0 1.5707963268\n");
  const auto plain = runProgram("evaluate_trajectory", trajectory + " --relations " + relations);
  EXPECT_EQ(plain.status, 0);
  EXPECT_THAT(plain.output, HasSubstr("relations.used 1 of 1\nshort.translation.mean 0.0566 m\n"));
  const auto moved = runProgram("evaluate_trajectory",
                                trajectory + " --relations " + relations + " --offset 0.04 0 0");
  EXPECT_THAT(moved.output, HasSubstr("all.translation.max 0.0800 m\n"));
}

TEST(EvaluateTrajectory, ComparesWithTruth) {
  const TemporaryFolder folder;
  const std::string trajectory = folder.write("a.tum", "1 0 0 0\n1.5 0.6 0 0\n9 1 0 0\n");
  const std::string truth = folder.write("b.tum", "1 0 0 0\n2 1 0 0\n");
  const auto result = runProgram("evaluate_trajectory", trajectory + " --truth " + truth);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output, HasSubstr("truth.used 2 of 3\nabsolute.translation.mean 0.0500 m\n"));
}

TEST(EvaluateTrajectory, FailsWhereNothingCanBeCompared) {
  const TemporaryFolder folder;
  const auto result =
      runProgram("evaluate_trajectory", folder.write("a.tum", "1 0 0 0\n") + " --truth " +
                                            folder.write("b.tum", "5 0 0 0\n"));
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("truth.used 0 of 1\n"));
}

TEST(EvaluateTrajectory, ExplainsItself) {
  for (const char* arguments : {"", "a.tum", "a.tum --relations a --truth b",
                                "a.tum --truth b --offset 1 2", "a.tum --truth b --offset 1 2 x"}) {
    const auto result = runProgram("evaluate_trajectory", arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_THAT(result.output, HasSubstr("usage: evaluate_trajectory")) << arguments;
  }
  const auto result = runProgram("evaluate_trajectory", "/none/a.tum --truth /none/b.tum");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("/none/a.tum: No such file"));
}

}  // namespace
}  // namespace sightline
