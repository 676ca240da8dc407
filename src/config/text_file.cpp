#include "sightline/config/text_file.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "sightline/config/error.h"

namespace sightline::config {

std::string readText(const std::string& path) {
  std::error_code unreadable;
  if (std::filesystem::is_directory(path, unreadable)) {
    throw Error(path, 0, "", "is a folder, not a file");
  }
  const std::ifstream file(path);
  if (!file) throw Error(path, 0, "", "no such file, or not readable");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace sightline::config
