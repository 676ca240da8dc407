#include <gmock/gmock.h>

#include "tools/program.h"

namespace sightline {
namespace {

using test::runProgram;
using testing::HasSubstr;

TEST(ReportRun, ExplainsItself) {
  EXPECT_EQ(runProgram("report_run", "--help").status, 0);
  for (const char* arguments : {"", "a.bag", "--out b", "a.bag --out", "a.bag c.bag --out b"}) {
    const auto result = runProgram("report_run", arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_THAT(result.output, HasSubstr("usage: report_run")) << arguments;
  }
  const auto result = runProgram("report_run", "/none/a.bag --out /none/b");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("/none/a.bag"));
}

}  // namespace
}  // namespace sightline
