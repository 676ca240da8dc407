#include <cerrno>
#include <filesystem>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "config_error.h"
#include "sightline/simulation/pseudo_terminal.h"
#include "temporary_folder.h"

namespace sightline::simulation {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PseudoTerminalTest : public ::testing::Test {
 protected:
  std::string fault(const std::string& path) const {
    return test::errorOf([&] { PseudoTerminal{path}; }).what();
  }

  test::TemporaryFolder folder_;
  const std::string path_ = folder_.path("port");
};

TEST_F(PseudoTerminalTest, BytesGoBothWaysAsTheyAre) {
  const PseudoTerminal terminal(path_);
  const int port = open(path_.c_str(), O_RDWR | O_NOCTTY);
  ASSERT_GE(port, 0);
  char byte = 0;
  for (const char sent : {'\n', '\r', '\x03', '\x11', '\xFF', '\0'}) {
    ASSERT_EQ(write(terminal.handle(), &sent, 1), 1);
    ASSERT_EQ(read(port, &byte, 1), 1);
    EXPECT_EQ(byte, sent);
    ASSERT_EQ(write(port, &sent, 1), 1);
    while (read(terminal.handle(), &byte, 1) < 0) ASSERT_EQ(errno, EAGAIN);
    EXPECT_EQ(byte, sent);
  }
  close(port);
}

TEST_F(PseudoTerminalTest, ReadingTellsWhenItsUserHasGone) {
  const PseudoTerminal terminal(path_);
  char byte = 0;
  EXPECT_EQ(read(terminal.handle(), &byte, 1), -1);
  EXPECT_EQ(errno, EAGAIN) << "nobody has come yet";
  close(open(path_.c_str(), O_RDWR | O_NOCTTY));
  EXPECT_EQ(read(terminal.handle(), &byte, 1), -1);
  EXPECT_EQ(errno, EIO);
}

TEST_F(PseudoTerminalTest, OnlyLinksToTerminalsAreReplaced) {
  fs::create_symlink("/dev/pts/987654", path_);
  { const PseudoTerminal terminal(path_); }
  EXPECT_FALSE(fs::is_symlink(path_));
  const std::string file = folder_.write("file", "kept");
  EXPECT_EQ(fault(file), file + ": exists, and is no link to a terminal");
  fs::create_symlink(file, path_);
  EXPECT_EQ(fault(path_), path_ + ": exists, and is no link to a terminal");
  EXPECT_EQ(fs::read_symlink(path_), file);
  EXPECT_EQ(fs::file_size(file), 4U);
}

TEST_F(PseudoTerminalTest, AnotherOneAtTheSamePathOutlivesTheFirst) {
  auto first = std::make_unique<PseudoTerminal>(path_);
  const PseudoTerminal second(path_);
  first.reset();
  EXPECT_TRUE(fs::is_symlink(path_));
}

TEST_F(PseudoTerminalTest, PathsThatCannotBeAreNamed) {
  const std::string long_name = folder_.path(std::string(300, 'x'));
  EXPECT_EQ(fault(long_name), long_name + ": no link: File name too long");
  const std::string below_file = folder_.write("file", "") + "/port";
  EXPECT_EQ(fault(below_file), below_file + ": no link: Not a directory");
  EXPECT_THAT(fault(folder_.path("")), HasSubstr("is no link to a terminal"));
}

}  // namespace
}  // namespace sightline::simulation
