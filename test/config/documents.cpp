// Faults of a document as a whole.
#include <random>

#include <gmock/gmock.h>

#include "config_error.h"
#include "sightline/config/node.h"
#include "temporary_folder.h"

namespace sightline::config {
namespace {

using test::errorOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Document, IsReadFromAFile) {
  const test::TemporaryFolder folder;
  const Node node = Node::readFile(folder.write("settings.yaml", "a: 1\nb: [1, 2]\n"));
  EXPECT_TRUE(node.isMap());
  EXPECT_EQ(node.at("a").integer(), 1);
  EXPECT_THAT(node.source(), testing::EndsWith("settings.yaml"));
}

TEST(Document, ThatIsMissingIsNamed) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("none.yaml");
  const Error error = errorOf([&] { Node::readFile(path); });
  EXPECT_EQ(error.source(), path);
  EXPECT_EQ(std::string(error.what()), path + ": no such file, or not readable");
}

TEST(Document, ThatIsAFolderIsNamed) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(errorOf([&] { Node::readFile(folder.path("")); }).reason(), HasSubstr("folder"));
}

TEST(Document, OfNoNameOrOfTooLongAOneIsAnError) {
  errorOf([] { Node::readFile(""); });
  errorOf([] { Node::readFile(std::string(5000, 'x')); });
}

TEST(Document, ThatIsNotYamlIsToldWithItsLine) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("settings.yaml", "a: 1\nb: 2\nc: [1, 2\nd: 3\n");
  const Error error = errorOf([&] { Node::readFile(path); });
  EXPECT_THAT(error.what(), StartsWith(path + ":"));
  EXPECT_THAT(error.reason(), StartsWith("not YAML: "));
  EXPECT_GE(error.line(), 3);
}

TEST(DocumentText, ThatIsEmptyIsNull) {
  for (const char* text : {"", "\n\n", "# nothing but a comment\n", "---\n", "~"}) {
    const Node node = Node::parse(text, "test.yaml");
    EXPECT_TRUE(node.isNull()) << text;
    EXPECT_FALSE(node.isMap()) << text;
    EXPECT_FALSE(node.has("a")) << text;
  }
}

TEST(DocumentText, MustBeOneDocument) {
  const Error error = errorOf([] { Node::parse("a: 1\n---\nb: 2\n", "test.yaml"); });
  EXPECT_EQ(error.line(), 2);
  EXPECT_THAT(error.reason(), HasSubstr("second document"));
}

TEST(DocumentText, ThatBeginsWithACommaIsAnError) {
  // yaml-cpp takes this for endlessly many empty documents.
  errorOf([] { Node::parse(", a\nrooms:\n", "test.yaml"); });
}

class BrokenText : public testing::TestWithParam<const char*> {};

TEST_P(BrokenText, IsAConfigurationError) {
  const Error error = errorOf([] { Node::parse(GetParam(), "test.yaml"); });
  EXPECT_EQ(error.source(), "test.yaml");
  EXPECT_GT(error.line(), 0);
  EXPECT_THAT(error.reason(), StartsWith("not YAML: "));
}

INSTANTIATE_TEST_SUITE_P(Faults, BrokenText,
                         testing::Values("a: [1, 2", "a: {b: 1", "a: b: c", "a: \"open", "\ta: 1",
                                         "a: \"\\q\"", "a: \"\\x1\"", "a: \"\\UFFFFFFFF\"", "a: *b",
                                         "a: &b &c 1", "]", "a: 1\n b: 2\n- c",
                                         "%YAML 9.9\n%YAML 1", "a: !<"));

TEST(DocumentText, NestedTooDeeplyIsAnError) {
  EXPECT_THAT(errorOf([] { Node::parse(std::string(20000, '['), "test.yaml"); }).reason(),
              StartsWith("not YAML: "));
  EXPECT_THAT(errorOf([] { Node::parse(std::string(20000, '{'), "test.yaml"); }).reason(),
              StartsWith("not YAML: "));
}

TEST(DocumentText, EndsInAnErrorOrInADocumentWhateverItsBytes) {
  const std::string seed = "rooms:\n  office: {size: [5.0, 3.0], pose: [\"1\", 'x', ~]}\n- &a *a\n";
  std::mt19937_64 random(1);
  int accepted = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = seed;
    for (int change = 0; change < 5; ++change) {
      text[random() % text.size()] = static_cast<char>(random());
      text.erase(random() % text.size(), random() % 4);
    }
    try {
      Node::parse(text, "test.yaml");
      ++accepted;
    } catch (const Error& error) {
      EXPECT_EQ(error.source(), "test.yaml");
    }
  }
  EXPECT_LT(accepted, 2000);
}

}  // namespace
}  // namespace sightline::config
