#include "sightline/simulation/pseudo_terminal.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include "sightline/config/error.h"

namespace sightline::simulation {

namespace {

namespace fs = std::filesystem;

// Empty where there is no link to a terminal, be it one of the past.
std::string terminalAt(const std::string& path) {
  std::error_code error;
  const fs::path target = fs::read_symlink(path, error);
  return !error && target.parent_path() == "/dev/pts" ? target.string() : "";
}

void makeRoom(const std::string& path) {
  std::error_code error;
  const auto there = fs::symlink_status(path, error);
  if (there.type() == fs::file_type::not_found) return;
  if (!error && terminalAt(path).empty()) {
    throw config::Error(path, 0, "", "exists, and is no link to a terminal");
  }
  if (!error) fs::remove(path, error);
  if (error) throw config::Error(path, 0, "", "no link: " + error.message());
}

// Settings of the one end are those of the other.
bool setUp(int master, std::string& name) {
  std::array<char, 128> text{};
  termios raw{};
  if (grantpt(master) != 0 || unlockpt(master) != 0 || tcgetattr(master, &raw) != 0) return false;
  if (ptsname_r(master, text.data(), text.size()) != 0) return false;
  cfmakeraw(&raw);
  name = text.data();
  return tcsetattr(master, TCSANOW, &raw) == 0;
}

}  // namespace

PseudoTerminal::PseudoTerminal(std::string path) : path_(std::move(path)) {
  makeRoom(path_);
  master_ = open("/dev/ptmx", O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  std::string trouble;
  std::error_code error;
  if (master_ < 0 || !setUp(master_, name_)) {
    trouble = std::string("no terminal: ") + std::strerror(errno);
  } else if (fs::create_symlink(name_, path_, error); error) {
    trouble = "no link: " + error.message();
  }
  if (trouble.empty()) return;
  if (master_ >= 0) close(master_);
  throw config::Error(path_, 0, "", trouble);
}

PseudoTerminal::~PseudoTerminal() {
  std::error_code ignored;
  if (terminalAt(path_) == name_) fs::remove(path_, ignored);
  close(master_);
}

}  // namespace sightline::simulation
