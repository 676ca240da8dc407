#include "sightline/logs/line_reader.h"

#include <vector>

#include <gmock/gmock.h>
#include <zlib.h>

#include "config_error.h"
#include "temporary_folder.h"

namespace sightline::logs {
namespace {

using test::errorOf;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> linesOf(LineReader& reader) {
  std::vector<std::string> lines;
  for (std::string line; reader.next(line);) lines.push_back(line);
  return lines;
}

std::string compress(const std::string& path, const std::string& content) {
  const gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, content.data(), static_cast<unsigned>(content.size()));
  gzclose(file);
  return path;
}

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(LineReader, TakesBothLineEndsAndCounts) {
  const TemporaryFolder folder;
  LineReader reader(folder.write("a.txt", "one\r\n\ntwo\n"));
  EXPECT_THAT(linesOf(reader), ElementsAre("one", "", "two"));
  EXPECT_EQ(reader.number(), 3);
  EXPECT_FALSE(reader.isUnterminated());
  EXPECT_FALSE(reader.isCutOff());
}

TEST(LineReader, SaysThatTheLastLineHasNoEnd) {
  const TemporaryFolder folder;
  LineReader reader(folder.write("a.txt", "one\ntw"));
  std::string line;
  ASSERT_TRUE(reader.next(line));
  EXPECT_FALSE(reader.isUnterminated());
  ASSERT_TRUE(reader.next(line));
  EXPECT_EQ(line, "tw");
  EXPECT_TRUE(reader.isUnterminated());
  EXPECT_FALSE(reader.next(line));
}

TEST(LineReader, ReadsLinesAcrossItsBufferFromCompressedFiles) {
  const TemporaryFolder folder;
  std::string content;
  std::vector<std::string> expected;
  for (int i = 0; i < 5000; ++i) {
    expected.push_back(std::string(static_cast<std::size_t>(i % 97), 'x') + std::to_string(i));
    content += expected.back() + "\n";
  }
  LineReader reader(compress(folder.path("a.gz"), content));
  EXPECT_EQ(linesOf(reader), expected);
  EXPECT_FALSE(reader.isCutOff());
}

TEST(LineReader, KeepsWhatPrecedesTheCutOfACompressedFile) {
  const TemporaryFolder folder;
  std::string content;
  for (int i = 0; i < 20000; ++i) content += std::to_string(i * 7919 % 10007) + "\n";
  const std::string whole = contentOf(compress(folder.path("a.gz"), content));
  LineReader reader(folder.write("cut.gz", whole.substr(0, whole.size() / 2)));
  const auto lines = linesOf(reader);
  EXPECT_TRUE(reader.isCutOff());
  ASSERT_GT(lines.size(), 5000U);
  EXPECT_EQ(lines[4999], std::to_string(4999 * 7919 % 10007));
}

TEST(LineReader, NamesFileAndLineOfDamagedCompression) {
  const TemporaryFolder folder;
  std::string content;
  for (int i = 0; i < 20000; ++i) content += std::to_string(i * 7919 % 10007) + "\n";
  std::string damaged = contentOf(compress(folder.path("a.gz"), content));
  for (std::size_t i = damaged.size() / 2; i < damaged.size() / 2 + 64; ++i) damaged[i] = '\x55';
  LineReader reader(folder.write("damaged.gz", damaged));
  const config::Error error = errorOf([&] { linesOf(reader); });
  EXPECT_THAT(error.source(), HasSubstr("damaged.gz"));
  EXPECT_GT(error.line(), 1);
}

TEST(LineReader, RefusesWhatIsNoTextFile) {
  const TemporaryFolder folder;
  EXPECT_THAT(errorOf([&] { LineReader reader(folder.path("none")); }).reason(),
              HasSubstr("No such file"));
  EXPECT_THAT(errorOf([&] { LineReader reader(folder.path("")); }).reason(), HasSubstr("folder"));
  LineReader reader(folder.write("zeros", std::string(3 << 20, '\0')));
  EXPECT_THAT(errorOf([&] { linesOf(reader); }).reason(), HasSubstr("1 MiB"));
}

}  // namespace
}  // namespace sightline::logs
