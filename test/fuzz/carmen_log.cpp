// Any text, read line by line as a CARMEN log: messages with whole fields, or config::Error.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "sightline/config/error.h"
#include "sightline/logs/carmen_log.h"

namespace {

using namespace sightline;

void checkLine(const std::string& line, int number) {
  try {
    const auto message = logs::parseCarmenLine(line, "fuzz", number);
    if (!message) return;
    const auto* laser = std::get_if<logs::CarmenLaser>(&*message);
    if (laser && !laser->remissions.empty() && laser->remissions.size() != laser->ranges.size()) {
      std::abort();
    }
  } catch (const config::Error& error) {
    if (error.line() != number) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  int number = 0;
  for (std::string line; std::getline(lines, line);) checkLine(line, ++number);
  return 0;
}
