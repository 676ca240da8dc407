// Any text, read as what a calibration rig recorded: one that reads back as written, or
// config::Error.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sightline/triangulation/calibration_recording.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sightline;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const triangulation::SensorParameters sensor;
  try {
    const auto recording =
        triangulation::readRecording(config::CsvTable::parse(text, "fuzz"), sensor);
    const std::string written = triangulation::toCsv(recording);
    const auto again =
        triangulation::readRecording(config::CsvTable::parse(written, "again"), sensor);
    if (triangulation::toCsv(again) != written) std::abort();
  } catch (const config::Error&) {
  }
  return 0;
}
