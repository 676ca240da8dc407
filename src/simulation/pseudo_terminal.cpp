#include "sightline/simulation/pseudo_terminal.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include "sightline/config/error.h"

namespace sightline::simulation {

namespace fs = std::filesystem;

PseudoTerminal::PseudoTerminal(std::string path) : path_(std::move(path)) {
  if (fs::exists(fs::symlink_status(path_)) && !fs::is_symlink(path_)) {
    throw config::Error(path_, 0, "", "exists, and is no link to a terminal");
  }
  termios raw{};
  cfmakeraw(&raw);
  std::array<char, 128> name{};
  if (openpty(&master_, &slave_, name.data(), &raw, nullptr) != 0) {
    throw config::Error(path_, 0, "", std::string("no terminal: ") + std::strerror(errno));
  }
  fcntl(master_, F_SETFL, O_NONBLOCK);
  fcntl(master_, F_SETFD, FD_CLOEXEC);
  fcntl(slave_, F_SETFD, FD_CLOEXEC);
  std::error_code error;
  fs::remove(path_, error);
  fs::create_symlink(name.data(), path_, error);
  if (!error) return;
  close(master_);
  close(slave_);
  throw config::Error(path_, 0, "", "no link: " + error.message());
}

PseudoTerminal::~PseudoTerminal() {
  std::error_code ignored;
  fs::remove(path_, ignored);
  close(slave_);
  close(master_);
}

}  // namespace sightline::simulation
