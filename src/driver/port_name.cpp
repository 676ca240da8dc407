#include "sightline/driver/port_name.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace sightline::driver {

namespace {

namespace fs = std::filesystem;

// Entries of a folder; none where it cannot be read.
fs::directory_iterator entriesOf(const fs::path& folder) {
  std::error_code ignored;
  return fs::directory_iterator(folder, fs::directory_options::skip_permission_denied, ignored);
}

bool isSameFile(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

bool isNumber(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char character) {
    return std::isdigit(character) != 0;
  });
}

bool holds(const fs::path& process, const std::string& port) {
  for (const fs::directory_entry& handle : entriesOf(process / "fd")) {
    if (isSameFile(handle.path(), port)) return true;
  }
  return false;
}

}  // namespace

std::string lastingName(const std::string& port, const std::string& folder) {
  for (const fs::directory_entry& link : entriesOf(folder)) {
    if (isSameFile(link.path(), port)) return link.path().string();
  }
  return {};
}

std::string holderOf(const std::string& port) {
  const std::string own = std::to_string(getpid());
  for (const fs::directory_entry& process : entriesOf("/proc")) {
    const std::string id = process.path().filename().string();
    if (!isNumber(id) || id == own || !holds(process.path(), port)) continue;
    std::string name;
    std::getline(std::ifstream(process.path() / "comm"), name);
    return fmt::format("{}, process {}", name, id);
  }
  return {};
}

}  // namespace sightline::driver
