#include "sightline/driver/port_name.h"

#include <filesystem>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "temporary_folder.h"

namespace sightline::driver {
namespace {

TEST(PortName, LinkThatLeadsToThePort) {
  const test::TemporaryFolder folder;
  const std::string port = folder.write("ttyUSB0", "");
  folder.write("ttyUSB1", "");
  std::filesystem::create_directory(folder.path("by-id"));
  std::filesystem::create_symlink("../ttyUSB1", folder.path("by-id") + "/usb-other");
  EXPECT_EQ(lastingName(port, folder.path("by-id")), "");
  std::filesystem::create_symlink("../ttyUSB0", folder.path("by-id") + "/usb-sensor");
  EXPECT_EQ(lastingName(port, folder.path("by-id")), folder.path("by-id") + "/usb-sensor");
  EXPECT_EQ(lastingName(port, folder.path("nowhere")), "");
}

TEST(PortName, ProgramThatHasItOpen) {
  const test::TemporaryFolder folder;
  const std::string port = folder.write("port", "");
  EXPECT_EQ(holderOf(port), "");
  const int handle = open(port.c_str(), O_RDONLY);
  EXPECT_EQ(holderOf(port), "") << "this program itself";
  close(handle);
  const pid_t child = fork();
  if (child == 0) {
    [[maybe_unused]] const int held = open(port.c_str(), O_RDONLY);
    pause();
    _exit(0);
  }
  std::string holder;
  for (int i = 0; i < 500 && holder.empty(); ++i) {
    usleep(10'000);
    holder = holderOf(port);
  }
  EXPECT_NE(holder.find(", process " + std::to_string(child)), std::string::npos) << holder;
  kill(child, SIGKILL);
}

}  // namespace
}  // namespace sightline::driver
