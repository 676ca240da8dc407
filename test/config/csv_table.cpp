#include "sightline/config/csv_table.h"

#include "config_error.h"
#include "temporary_folder.h"

namespace sightline::config {
namespace {

using test::errorOf;

TEST(CsvTable, ReadsColumnsByName) {
  const auto table =
      CsvTable::parse("# made by hand\n b , a\n\n1.5, x\r\n  # more\n-2,\n", "t.csv");
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.row(0).text("a"), "x");
  EXPECT_EQ(table.row(0).number("b"), 1.5);
  EXPECT_EQ(table.row(1).text("a"), "");
  EXPECT_EQ(table.row(1).integer("b"), -2);
  EXPECT_TRUE(table.has("a"));
  EXPECT_FALSE(table.has("c"));
}

TEST(CsvTable, BeginsAfterAByteOrderMark) {
  const auto table = CsvTable::parse(
      "\xEF\xBB\xBF"
      "a,b\n1,2\n",
      "t.csv");
  EXPECT_EQ(table.row(0).number("a"), 1.0);
}

TEST(CsvTable, NamesFileLineAndColumn) {
  const auto table = CsvTable::parse("a,b\n1,2\n\n3,4x\n", "t.csv");
  const auto missing = errorOf([&] { table.row(1).number("c"); });
  EXPECT_STREQ(missing.what(), "t.csv:1: c: missing column; there are: a, b");
  const auto no_number = errorOf([&] { table.row(1).number("b"); });
  EXPECT_STREQ(no_number.what(), "t.csv:4: b: expected a number, found '4x'");
  const auto outside = errorOf([&] { table.row(0).number("b", {3.0, 5.0}); });
  EXPECT_STREQ(outside.what(), "t.csv:2: b: 2 is outside [3, 5]");
}

TEST(CsvTable, RefusesWhatIsNoNumber) {
  for (const char* cell : {"", "nan", "inf", "1e999", "1 2", "--1"}) {
    const auto table = CsvTable::parse(std::string("a,b\n") + cell + ",0\n", "t.csv");
    EXPECT_EQ(errorOf([&] { table.row(0).number("a"); }).line(), 2) << cell;
  }
  const auto table = CsvTable::parse("a\n1.5\n1e12\n", "t.csv");
  EXPECT_EQ(errorOf([&] { table.row(0).integer("a"); }).key(), "a");
  EXPECT_EQ(errorOf([&] { table.row(1).integer("a"); }).key(), "a");
}

TEST(CsvTable, RefusesWhatIsNoTable) {
  const auto parse = [](const char* text) {
    return errorOf([&] { CsvTable::parse(text, "t.csv"); });
  };
  EXPECT_EQ(parse("").line(), 0);
  EXPECT_EQ(parse("# nothing\n").line(), 0);
  EXPECT_EQ(parse("a,a\n").key(), "a");
  EXPECT_EQ(parse("a,,b\n").line(), 1);
  EXPECT_EQ(parse("a,b\n1,2\n1,2,3\n").line(), 3);
  EXPECT_EQ(errorOf([] { CsvTable::readFile("/none.csv"); }).source(), "/none.csv");
  EXPECT_EQ(errorOf([] { CsvTable::readFile("/tmp"); }).reason(), "is a folder, not a file");
  const test::TemporaryFolder folder;
  EXPECT_EQ(CsvTable::readFile(folder.write("t.csv", "a\n7\n")).row(0).integer("a"), 7);
}

}  // namespace
}  // namespace sightline::config
