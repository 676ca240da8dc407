#include "tools/program/program.h"

#include <vector>

#include <gmock/gmock.h>

namespace sightline {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// A program with one word and one option of each kind, and what it said.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest() {
    program_.positional("WORD", word_, "a word");
    program_.flag("--flag", flag_, "a flag");
    program_.option("--number", number_, "METRES", "a number");
    program_.option("--count", count_, "N", "a whole number");
    program_.option("--seed", seed_, "N", "a whole number, or none");
    program_.option("--pose", pose_, "X Y THETA", "a pose");
    program_.option("--text", text_, "TEXT", "a text");
  }

  int run(std::vector<const char*> words) {
    words.insert(words.begin(), "program");
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int status = program_.run(static_cast<int>(words.size()), words.data(), body_);
    output_ = testing::internal::GetCapturedStdout();
    errors_ = testing::internal::GetCapturedStderr();
    return status;
  }

  void expectRefusal(const std::vector<const char*>& words, const std::string& reason) {
    EXPECT_EQ(run(words), 2) << reason;
    EXPECT_THAT(errors_, AllOf(HasSubstr(reason), HasSubstr("usage: program")));
    EXPECT_EQ(runs_, 0) << reason;
  }

  tools::Program program_{"program", "Does something."};
  std::string word_;
  bool flag_ = false;
  double number_ = 7.0;
  std::uint64_t count_ = 5;
  std::optional<std::uint64_t> seed_;
  std::array<double, 3> pose_{1.0, 2.0, 3.0};
  std::optional<std::string> text_;
  int runs_ = 0;
  std::function<int()> body_ = [this] { return runs_++; };
  std::string output_;
  std::string errors_;
};

TEST_F(ProgramTest, KeepsWhatIsNotGiven) {
  EXPECT_EQ(run({"a"}), 0);
  EXPECT_EQ(runs_, 1);
  EXPECT_EQ(word_, "a");
  EXPECT_FALSE(flag_);
  EXPECT_EQ(number_, 7.0);
  EXPECT_EQ(count_, 5u);
  EXPECT_FALSE(seed_);
  EXPECT_THAT(pose_, ElementsAre(1.0, 2.0, 3.0));
  EXPECT_FALSE(text_);
}

TEST_F(ProgramTest, TakesWholeNumbersToTheLastDigit) {
  EXPECT_EQ(run({"a", "--count", "18446744073709551615", "--seed", "0"}), 0);
  EXPECT_EQ(count_, 18446744073709551615u);
  EXPECT_EQ(seed_, 0u);
}

TEST_F(ProgramTest, RefusesWhatIsNoWholeNumber) {
  for (const char* number : {"x", "1x", "", "-1", "1.5", "1e3", "18446744073709551616"}) {
    const std::string reason = std::string("needs a whole number, not '") + number + "'";
    expectRefusal({"a", "--count", number}, "--count: " + reason);
    expectRefusal({"a", "--seed", number}, "--seed: " + reason);
  }
  EXPECT_EQ(count_, 5u);
  EXPECT_FALSE(seed_);
}

TEST_F(ProgramTest, TakesOptionsInAnyOrder) {
  EXPECT_EQ(run({"--number", "1e-3", "--pose", "0.5", "1", "2", "a", "--text", "b", "--flag"}), 0);
  EXPECT_EQ(word_, "a");
  EXPECT_TRUE(flag_);
  EXPECT_EQ(number_, 1e-3);
  EXPECT_THAT(pose_, ElementsAre(0.5, 1.0, 2.0));
  EXPECT_EQ(text_, "b");
}

TEST_F(ProgramTest, TakesNegativeNumbersForValues) {
  EXPECT_EQ(run({"a", "--pose", "-0.04", "-.5", "-1e-3", "--number", "-2"}), 0);
  EXPECT_THAT(pose_, ElementsAre(-0.04, -0.5, -1e-3));
  EXPECT_EQ(number_, -2.0);
}

TEST_F(ProgramTest, TellsAnEmptyTextFromNone) {
  EXPECT_EQ(run({"a", "--text", ""}), 0);
  EXPECT_EQ(text_, "");
}

TEST_F(ProgramTest, RefusesWhatIsNotAFiniteNumber) {
  for (const char* number : {"x", "1x", "", "inf", "-inf", "nan", "1e999"}) {
    const std::string reason = std::string("needs a number, not '") + number + "'";
    expectRefusal({"a", "--number", number}, "--number: " + reason);
    expectRefusal({"a", "--pose", "0", number, "0"}, "--pose: " + reason);
  }
  EXPECT_EQ(number_, 7.0);
  EXPECT_THAT(pose_, ElementsAre(1.0, 2.0, 3.0));
}

TEST_F(ProgramTest, NamesWhatIsMissingUnknownOrTwice) {
  expectRefusal({}, "WORD");
  expectRefusal({"a", "b"}, "b");
  expectRefusal({"a", "--unknown"}, "--unknown");
  expectRefusal({"a", "--number"}, "--number");
  expectRefusal({"a", "--pose", "1", "2"}, "--pose");
  expectRefusal({"a", "--number", "1", "--number", "2"}, "--number");
  expectRefusal({"a", "--pose", "1", "2", "3", "--pose", "1", "2", "3"}, "--pose");
  expectRefusal({"a", "--text", "b", "--text", "c"}, "--text");
  expectRefusal({"a", "--flag", "--flag"}, "--flag");
}

TEST_F(ProgramTest, NamesTheOptionItCannotDoWithout) {
  std::string needed;
  program_.requiredOption("--needed", needed, "FILE", "a file");
  expectRefusal({"a"}, "--needed");
  EXPECT_EQ(run({"a", "--needed", "b"}), 0);
  EXPECT_EQ(needed, "b");
}

TEST_F(ProgramTest, HelpsWhateverElseIsWrong) {
  const std::vector<std::vector<const char*>> lines{
      {"--help"}, {"a", "--help"}, {"a", "--number", "x", "--help"}, {"--unknown", "--help"}};
  for (const auto& words : lines) {
    EXPECT_EQ(run(words), 0);
    EXPECT_THAT(output_, AllOf(HasSubstr("Does something."), HasSubstr("usage: program"),
                               HasSubstr("--pose X Y THETA"), HasSubstr("a pose")));
    EXPECT_EQ(errors_, "");
  }
  EXPECT_EQ(runs_, 0);
}

TEST_F(ProgramTest, EndsAsItsBodyDoes) {
  body_ = [] { return 3; };
  EXPECT_EQ(run({"a"}), 3);
  body_ = []() -> int { throw std::runtime_error("no such file"); };
  EXPECT_EQ(run({"a"}), 1);
  EXPECT_EQ(errors_, "no such file\n");
  body_ = []() -> int { throw tools::UsageError("one of the two"); };
  EXPECT_EQ(run({"a"}), 2);
  EXPECT_THAT(errors_, AllOf(HasSubstr("one of the two\n"), HasSubstr("usage: program")));
}

}  // namespace
}  // namespace sightline
