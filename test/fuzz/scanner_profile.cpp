// Any text, read as the profile of a scanner: one that can sweep, or config::Error.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sightline/simulation/scanner_profile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sightline;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    simulation::ScannerProfile profile;
    config::read(config::Node::parse(text, "fuzz"), profile);
    profile.check("fuzz");
    if (profile.geometry()->beams() != static_cast<std::size_t>(profile.beams)) std::abort();
  } catch (const config::Error&) {
  }
  return 0;
}
