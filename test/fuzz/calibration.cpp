// Any text, read as the calibration of a sensor: one that turns any current into a range, or says
// why not, or config::Error.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sightline/triangulation/ranger.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sightline;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const triangulation::Ranger ranger(
        triangulation::Calibration::read(config::Node::parse(text, "fuzz")));
    for (const double share : {0.0, 0.3, 0.5, 0.7, 1.0}) {
      const auto reading = ranger.read(0, {share * 1e-8, (1.0 - share) * 1e-8});
      const bool is_valid = reading.kind == scan::ReturnKind::kValid;
      if (is_valid && !(reading.range > 0.0 && reading.variance > 0.0)) std::abort();
    }
  } catch (const config::Error&) {
  }
  return 0;
}
