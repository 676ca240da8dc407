#include "sightline/logs/fields.h"

#include <cmath>

#include <gmock/gmock.h>

#include "config_error.h"

namespace sightline::logs {
namespace {

using test::errorOf;

TEST(ParseStamp, KeepsEveryDigit) {
  EXPECT_EQ(parseStamp("1071078718.462310"), 1071078718462310000);
  EXPECT_EQ(parseStamp("1071078718.123456789"), 1071078718123456789);
  EXPECT_EQ(parseStamp("1211.5"), 1211500000000);
  EXPECT_EQ(parseStamp("17"), 17000000000);
  EXPECT_EQ(parseStamp("-0.25"), -250000000);
}

TEST(ParseStamp, TakesExponents) {
  EXPECT_EQ(parseStamp("1.2115e+03"), 1211500000000);
  EXPECT_EQ(parseStamp("1.000000000000000000e+00"), 1000000000);
}

TEST(ParseStamp, RefusesWhatIsNoTime) {
  for (const char* text : {"", "-", ".", "abc", "12x", "1.5.2", "nan", "inf", "1e30",
                           "99999999999999999999", "9223372036.9"}) {
    EXPECT_EQ(parseStamp(text), std::nullopt) << text;
  }
}

TEST(FormatStamp, ComesBackTheSame) {
  for (const std::int64_t stamp : {0L, 1L, -1L, 1071078718462310000L, -1500000000L}) {
    EXPECT_EQ(parseStamp(formatStamp(stamp)), stamp);
  }
  EXPECT_EQ(formatStamp(-1500000000), "-1.500000000");
}

TEST(Fields, ReadsFromLeftToRight) {
  const std::string line = " ODOM\t1.5 -2e1  nan 3 12.5 ";
  Fields fields(line, "a.clf", 7);
  EXPECT_EQ(fields.word("kind"), "ODOM");
  EXPECT_EQ(fields.finite("x"), 1.5);
  EXPECT_EQ(fields.finite("y"), -20.0);
  EXPECT_TRUE(std::isnan(fields.number("range")));
  EXPECT_EQ(fields.count("beams", 3), 3U);
  EXPECT_EQ(fields.stamp("time"), 12500000000);
  EXPECT_TRUE(fields.atEnd());
}

TEST(Fields, SaysWhatIsWrongAndWhere) {
  const std::string line = "x1 nan";
  Fields fields(line, "a.clf", 7);
  fields.setKey("ODOM");
  EXPECT_STREQ(errorOf([&] { fields.number("y"); }).what(),
               "a.clf:7: ODOM: y: expected a number, found 'x1'");
  EXPECT_STREQ(errorOf([&] { fields.finite("x"); }).what(),
               "a.clf:7: ODOM: x: expected a finite number, found 'nan'");
  EXPECT_STREQ(errorOf([&] { fields.word("host"); }).what(),
               "a.clf:7: ODOM: the line ends where host should be");
}

TEST(Fields, BoundsCounts) {
  for (const std::string line : {"-1", "4", "2.5", "x"}) {
    Fields fields(line, "a.clf", 1);
    EXPECT_THROW(fields.count("beams", 3), config::Error) << line;
  }
}

}  // namespace
}  // namespace sightline::logs
