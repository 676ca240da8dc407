#include "sightline/config/node.h"

#include <gmock/gmock.h>

#include "config_error.h"

namespace sightline::config {
namespace {

using test::errorOf;
using testing::ElementsAre;
using testing::HasSubstr;

Node parse(const std::string& text) {
  return Node::parse(text, "test.yaml");
}

Node value(const std::string& text) {
  return parse("group:\n  value: " + text + "\n").at("group").at("value");
}

TEST(Node, SaysFileLineKeyAndValueOfAWrongType) {
  const Node document = parse("a: 1\ngroup:\n  name: many\n");
  const Error error = errorOf([&] { document.at("group").at("name").number(); });
  EXPECT_STREQ(error.what(), "test.yaml:3: group.name: expected a number, found 'many'");
  EXPECT_EQ(error.line(), 3);
  EXPECT_EQ(error.key(), "group.name");
}

TEST(Node, SaysWhichKeyIsMissingAndWhere) {
  const Node document = parse("a: 1\ngroup:\n  name: many\n");
  const Error error = errorOf([&] { document.at("group").at("size"); });
  EXPECT_EQ(error.key(), "group");
  EXPECT_EQ(error.line(), 3);  // where the map begins
  EXPECT_EQ(error.reason(), "missing key 'size'");
  EXPECT_THAT(errorOf([&] { document.at("b"); }).what(), HasSubstr("test.yaml:1: missing key 'b'"));
  EXPECT_THAT(errorOf([&] { document.at("a").at("b"); }).reason(), HasSubstr("expected a map"));
}

TEST(Node, SaysTheRangeThatANumberIsOutsideOf) {
  EXPECT_STREQ(errorOf([] {
                 value("1.5").number({0.0, 1.0});
               }).what(),
               "test.yaml:2: group.value: 1.5 is outside [0, 1]");
  EXPECT_EQ(errorOf([] { value("0").number(kPositive); }).reason(), "0 is outside > 0");
  EXPECT_EQ(errorOf([] { value("-3").integer(kNotNegative); }).reason(), "-3 is outside >= 0");
}

TEST(Node, KeepsRangesWithBothBoundsIncluded) {
  EXPECT_EQ(value("0").number({0.0, 1.0}), 0.0);
  EXPECT_EQ(value("1").number({0.0, 1.0}), 1.0);
  EXPECT_EQ(value("0").number(kNotNegative), 0.0);
  EXPECT_EQ(value("7").integer({7.0, 7.0}), 7);
}

TEST(Node, ReadsNumbersAsYamlWritesThem) {
  EXPECT_EQ(value("1e-3").number(), 1e-3);
  EXPECT_EQ(value("-.5").number(), -0.5);
  EXPECT_EQ(value("+2").number(), 2.0);
  EXPECT_EQ(value("12").integer(), 12);
}

TEST(Node, NeverTakesWhatIsNoNumber) {
  for (const char* text : {".nan", ".NaN"}) {
    EXPECT_THAT(errorOf([&] { value(text).number(); }).reason(), HasSubstr("NaN")) << text;
  }
  for (const char* text :
       {"nan", "one", "1 2", "1,5", "1e999", "true", "''", "", "~", "[1]", "{}"}) {
    EXPECT_THAT(errorOf([&] { value(text).number(); }).reason(), HasSubstr("expected a number"))
        << text;
  }
  for (const char* text : {"1.5", "1e3", "3000000000", "-3000000000", "", "x", ".inf"}) {
    EXPECT_THAT(errorOf([&] { value(text).integer(); }).reason(),
                HasSubstr("expected a whole number"))
        << text;
  }
}

TEST(Node, TakesInfinityOnlyWhereTheRangeIsOpen) {
  EXPECT_TRUE(std::isinf(value(".inf").number()));
  EXPECT_THAT(errorOf([] { value(".inf").number(kPositive); }).reason(), HasSubstr("outside"));
  EXPECT_THAT(errorOf([] { value("-.inf").number({-5.0, 5.0}); }).reason(), HasSubstr("outside"));
}

TEST(Node, ReadsFlagsAndTexts) {
  EXPECT_TRUE(value("true").flag());
  EXPECT_FALSE(value("off").flag());
  EXPECT_THAT(errorOf([] { value("maybe").flag(); }).reason(), HasSubstr("true or false"));
  EXPECT_TRUE(value("1").flag());
  EXPECT_FALSE(value("0").flag());
  EXPECT_THAT(errorOf([] { value("2").flag(); }).reason(), HasSubstr("true or false"));
  EXPECT_EQ(value("12 monkeys").text(), "12 monkeys");
  EXPECT_THAT(errorOf([] { value("[a]").text(); }).reason(), HasSubstr("expected a text"));
}

TEST(Node, ReadsListsOfFiniteNumbers) {
  EXPECT_THAT(value("[1, 2.5, -3]").numbers(), ElementsAre(1.0, 2.5, -3.0));
  EXPECT_TRUE(value("[]").numbers().empty());
  const Error short_list = errorOf([] { value("[1, 2]").numbers(3); });
  EXPECT_EQ(short_list.reason(), "expected 3 numbers, found 2");
  const Error infinite = errorOf([] { value("[1, .inf]").numbers(); });
  EXPECT_EQ(infinite.key(), "group.value[1]");
  EXPECT_THAT(infinite.reason(), HasSubstr("finite"));
  const Error outside = errorOf([] { value("[0.5, 2]").numbers(2, {0.0, 1.0}); });
  EXPECT_EQ(outside.key(), "group.value[1]");
  EXPECT_EQ(outside.reason(), "2 is outside [0, 1]");
  EXPECT_THAT(errorOf([] { value("3").numbers(); }).reason(), HasSubstr("expected a sequence"));
}

TEST(Node, FallsBackOnlyWhereTheKeyIsAbsent) {
  const Node document = parse("a: 1\nb: word\nc:\n");
  EXPECT_EQ(document.numberOr("a", 5.0), 1.0);
  EXPECT_EQ(document.numberOr("z", 5.0), 5.0);
  EXPECT_EQ(document.textOr("b", "none"), "word");
  EXPECT_EQ(document.textOr("z", "none"), "none");
  errorOf([&] { document.numberOr("b", 5.0); });
  errorOf([&] { document.numberOr("c", 5.0); });
  errorOf([&] { document.numberOr("a", 5.0, {2.0, 3.0}); });
}

TEST(Node, ListsEntriesInTheOrderOfTheFile) {
  std::vector<std::string> keys;
  for (const auto& [key, node] : parse("zebra: 1\napple: 2\n0: 3\n").entries()) {
    keys.push_back(key);
    EXPECT_EQ(node.key(), key);
  }
  EXPECT_THAT(keys, ElementsAre("zebra", "apple", "0"));
  EXPECT_THAT(errorOf([] { parse("[1, 2]").entries(); }).reason(), HasSubstr("expected a map"));
  EXPECT_THAT(errorOf([] { parse("? [1, 2]\n: 3\n").entries(); }).reason(), HasSubstr("a text"));
}

TEST(Node, RefusesAKeyThatStandsTwice) {
  const Node document = parse("a: 1\nb: 2\na: 3\n");
  const Error error = errorOf([&] { document.at("a"); });
  EXPECT_EQ(error.line(), 3);
  EXPECT_EQ(error.key(), "a");
  EXPECT_EQ(error.reason(), "given twice");
  EXPECT_EQ(errorOf([&] { document.entries(); }).line(), 3);
  EXPECT_EQ(document.at("b").integer(), 2);
}

TEST(Node, RefusesKeysThatAreNotListed) {
  const Node document = parse("size: 1\nspeed: 2\nsped: 3\n");
  const Error error = errorOf([&] { document.allowOnly({"size", "speed"}); });
  EXPECT_STREQ(error.what(), "test.yaml:3: sped: unknown key; known are: size, speed");
  document.allowOnly({"size", "speed", "sped"});
}

TEST(Node, FollowsAliases) {
  const Node document = parse("a: &x [1, 2]\nb: *x\n");
  EXPECT_THAT(document.at("b").numbers(), ElementsAre(1.0, 2.0));
  // A list that holds itself ends where a number is asked for.
  errorOf([] { parse("a: &x [1, *x]\n").at("a").numbers(); });
}

TEST(Node, IsAssignedWithoutWritingIntoTheDocument) {
  const Node document = parse("a: 1\nb: 2\n");
  Node place = document.at("a");
  place = document.at("b");
  EXPECT_EQ(place.integer(), 2);
  EXPECT_EQ(place.key(), "b");
  EXPECT_EQ(document.at("a").integer(), 1);
}

TEST(Node, WithoutATextHasNoLine) {
  YAML::Node tree;
  tree["a"] = "word";
  const Error error = errorOf([&] { Node(tree, "/robot/tracker").at("a").number(); });
  EXPECT_STREQ(error.what(), "/robot/tracker: a: expected a number, found 'word'");
}

TEST(Node, ReadsPathsRelativeToItsDocument) {
  const Node document =
      Node::parse("map: ../rooms/lab.yaml\nlog: /data/a.clf\n", "config/robot.yaml");
  EXPECT_EQ(document.at("map").path(), "rooms/lab.yaml");
  EXPECT_EQ(document.at("log").path(), "/data/a.clf");
}

TEST(Range, ReadsAsAPersonWritesIt) {
  EXPECT_EQ(Range{}.text(), "any");
  EXPECT_EQ(kPositive.text(), "> 0");
  EXPECT_EQ(kNotNegative.text(), ">= 0");
  EXPECT_EQ((Range{0.5, 2.0}).text(), "[0.5, 2]");
  EXPECT_FALSE(Range{}.contains(std::numeric_limits<double>::quiet_NaN()));
}

TEST(Error, LeavesOutWhatIsUnknown) {
  EXPECT_STREQ(Error("f.yaml", 3, "k", "bad").what(), "f.yaml:3: k: bad");
  EXPECT_STREQ(Error("f.yaml", 0, "k", "bad").what(), "f.yaml: k: bad");
  EXPECT_STREQ(Error("f.yaml", 3, "", "bad").what(), "f.yaml:3: bad");
  EXPECT_STREQ(Error("", 0, "k", "bad").what(), "k: bad");
}

}  // namespace
}  // namespace sightline::config
